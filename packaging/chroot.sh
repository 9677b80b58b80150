# A fresh Debian in a folder, in which the project is tried. It needs root, mmdebstrap, and /proc as in a usual system.
# Usage: chroot=FOLDER; . chroot.sh; make_chroot SUITE; copy_sources FOLDER; install_in_chroot PACKAGE...; inside COMMAND
# shellcheck shell=bash disable=SC2154 # chroot is the caller's

((EUID == 0)) || {
    echo "Setting up a new Debian in a folder needs root: run this command as root" >&2
    exit 2
}

say() { printf '==> %s\n' "$*"; }

# Prints the system's sources of Debian's packages; for another release than the running one, only the main archive.
entries() {
    local suite=$1 own
    own=$(. /etc/os-release && printf '%s' "$VERSION_CODENAME")
    # shellcheck disable=SC2016 # apt fills them in
    if [[ $suite == "$own" ]]; then
        apt-get indextargets --format 'deb $(REPO_URI) $(RELEASE) $(COMPONENT)' 'Created-By: Packages' 'Origin: Debian' | sort -u
    else
        apt-get indextargets --format 'deb $(REPO_URI) '"$suite"' main' 'Created-By: Packages' 'Origin: Debian' \
            "Codename: $own" | sort -u | head -n 1
    fi
}

# With /proc, by which programs find the libraries in their own build folder; it is gone when the command ends.
inside() {
    unshare --mount sh -c 'mount -t proc proc "$0/proc" && exec chroot "$0" env -i "$@"' "$chroot" \
        PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive "$@"
}

# ninja_in <folder in /tmp> [target]: prints the last line, or everything after a failure.
ninja_in() {
    local said=$chroot/tmp/building
    inside ninja -C "/tmp/$1" "${@:2}" >"$said" || { cat "$said" >&2 && return 1; }
    tail -n 1 "$said"
}

install_in_chroot() { inside apt-get -q -o Dpkg::Use-Pty=0 install --yes --no-install-recommends "$@" >/dev/null; }

# The chroot accepts an archive out of date, as a snapshot is after some days, if this system does. Signatures are checked.
apt_options() {
    local check=true
    eval "$(apt-config shell check Acquire::Check-Valid-Until)" # nothing unless it is set
    [[ ! $check =~ ^(false|no|off|without|disable|0)$ ]] || printf '%s\n' '--aptopt=Acquire::Check-Valid-Until "false"'
}

make_chroot() {
    local options
    mapfile -t options < <(apt_options)
    say "Setting up a new Debian: $1"
    rm -rf "$chroot"
    mkdir -p "$(dirname "$chroot")"
    entries "$1" | mmdebstrap --quiet --variant=apt --include=ca-certificates "${options[@]}" "$1" "$chroot" -
    inside apt-get -q update >/dev/null
}

# shellcheck source=source_files.sh
. "$(dirname "${BASH_SOURCE[0]}")/source_files.sh"

copy_sources() { copy_source_files "$1" "$chroot/tmp/sources"; }

# build_with <folder in /tmp> <C compiler> <C++ compiler> [options of cmake]: installs into a prefix beside the build.
build_with() {
    local said=$chroot/tmp/configuring
    say "Building the sources by $3 with libode-dev alone"
    inside cmake -S /tmp/sources -B "/tmp/$1" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_C_COMPILER="$2" \
        -DCMAKE_CXX_COMPILER="$3" -DODE_PREDICTIVE_SPACE_BUILD_TESTS=OFF -DODE_PREDICTIVE_SPACE_BUILD_DEMOS=OFF \
        -DODE_PREDICTIVE_SPACE_WARNINGS_AS_ERRORS=ON -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON -DCMAKE_UNITY_BUILD=ON \
        -DCMAKE_UNITY_BUILD_BATCH_SIZE=20 "${@:4}" 2>"$said" >/dev/null || { cat "$said" >&2 && return 1; }
    if grep --after-context=5 'CMake .*Warning' "$said" >&2; then
        return 1
    fi
    ninja_in "$1"
    inside cmake --install "/tmp/$1" --prefix "/tmp/$1/prefix" >/dev/null
}

# build_consumers <folder in /tmp> [options of cmake]: builds programs of another project with the CMake package.
build_consumers() {
    inside cmake -S /tmp/sources/tests/install/consumer -B "/tmp/$1" -G Ninja "${@:2}" >/dev/null
    ninja_in "$1"
    inside sh -c 'cd "$0" && ctest --output-on-failure' "/tmp/$1"
}

test_contract() {
    say 'Building and running the tests of the contract'
    install_in_chroot libgtest-dev libbenchmark-dev libcli11-dev nlohmann-json3-dev
    inside cmake -S /tmp/sources -B /tmp/tests -G Ninja -DCMAKE_BUILD_TYPE=Release -DODE_PREDICTIVE_SPACE_BUILD_DEMOS=OFF \
        -DODE_PREDICTIVE_SPACE_BUILD_TESTS=ON "$@" >/dev/null
    ninja_in tests tests_of_contract
    inside sh -c 'cd /tmp/tests && ctest --label-regex "^contract$" --parallel "$(nproc)" --output-on-failure' | tail -n 8
}

show_versions() { for package in "$@"; do inside dpkg-query --show "$package"; done; }
