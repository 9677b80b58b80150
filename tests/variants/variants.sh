# Included by `./run dev variants`: builds of the project by other compilers, for other processors and with other builds of ODE,
# each of which runs the tests of the contract and of random histories.

all_variants=(clang clang-v3 scalar ode-release ode-single arm64)

# test_variant <name> <test programs> [options of cmake]
test_variant() {
    local folder=build/variants/$1 programs
    say "Variant $1"
    read -ra programs <<<"$2"
    shift 2
    cmake -S . -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=Release -DODE_PREDICTIVE_SPACE_BUILD_DEMOS=OFF \
        -DCMAKE_UNITY_BUILD=ON -DODE_SOURCE_DIR= "$@" >/dev/null
    cmake --build "$folder" --target "${programs[@]}"
    ctest --test-dir "$folder" --parallel "$(nproc)" --output-on-failure --no-tests=error \
        --label-regex '^(contract|differential)$'
}

promised="contract_tests differential_tests"

test_with_clang() {
    need clang
    test_variant "$1" "$promised" -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ "${@:2}"
}

# Sets arm64_root to a folder with the tests' packages for arm64, as libode-dev cannot be installed for two processors.
fetch_arm64_root() {
    local work=$top/build/arm64-root package list
    arm64_root=$work/root
    if [[ -d $arm64_root ]]; then
        return
    fi
    say "Fetching libraries for arm64"
    rm -rf "$work"
    mkdir -p "$work"/{entries,lists/partial,packages,unpacked}
    for list in /etc/apt/sources.list /etc/apt/sources.list.d/*.list /etc/apt/sources.list.d/*.sources; do
        [[ ! -f $list ]] || cp "$list" "$work/entries"
    done
    write_apt_settings "$work"
    printf '%s\n' 'APT::Architecture "arm64";' 'APT::Architectures { "arm64"; };' 'Dir::State::status "/dev/null";' \
        >>"$work/apt.conf"
    apt-get --config-file "$work/apt.conf" --quiet update >&2
    (cd "$work/packages" && apt-get --config-file "$work/apt.conf" --quiet download libode-dev libode8 libccd2 \
        libgtest-dev libbenchmark-dev libbenchmark1debian >&2)
    for package in "$work"/packages/*.deb; do
        dpkg-deb --extract "$package" "$work/unpacked"
    done
    mv "$work/unpacked" "$arm64_root"
}

test_on_arm64() {
    local arm64_root
    need arm64
    fetch_arm64_root
    test_variant arm64 contract_tests -DCMAKE_TOOLCHAIN_FILE="$top/tests/variants/arm64.cmake" \
        -DARM64_ROOT="$arm64_root"
}

run_variant() {
    local ode=$top/build/$1
    case $1 in
    clang) test_with_clang clang ;;
    clang-v3) test_with_clang clang-v3 -DCMAKE_CXX_FLAGS=-march=x86-64-v3 ;;
    scalar) test_variant scalar "$promised" -DCMAKE_CXX_FLAGS=-U__SSE2__ ;;
    ode-release)
        build_ode_release "$ode"
        test_variant ode-release "$promised" -DCMAKE_PREFIX_PATH="$ode"
        ;;
    ode-single)
        build_ode "$ode" -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=-O2 -DODE_DOUBLE_PRECISION=OFF
        test_variant ode-single "$promised" -DCMAKE_PREFIX_PATH="$ode"
        ;;
    arm64) test_on_arm64 ;;
    esac
}

test_variants() {
    local name
    for name in "$@"; do
        [[ " ${all_variants[*]} " == *" $name "* ]] || misused "there is no variant '$name'; there are ${all_variants[*]}"
    done
    (($# > 0)) || set -- "${all_variants[@]}"
    need library demo tests
    for name in "$@"; do
        run_variant "$name"
    done
}
