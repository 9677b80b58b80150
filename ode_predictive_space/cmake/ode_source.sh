# ODE's source, and builds of ODE from it. `./run` includes this file and has the functions that it calls.
# shellcheck shell=bash

ode_version() {
    local version
    version=$(pkg-config --modversion ode 2>/dev/null) ||
        fail "pkg-config does not find the Open Dynamics Engine: install libode-dev, or set PKG_CONFIG_PATH to its ode.pc"
    printf '%s' "$version"
}

# Writes the system's binary package sources as source package sources into the folder $1.
derive_source_entries() {
    local file
    for file in /etc/apt/sources.list /etc/apt/sources.list.d/*.list; do
        if [[ -f $file ]]; then
            sed -nE '/cdrom:/d; s/^deb([[:space:]])/deb-src\1/p' "$file" >"$1/$(basename "$file" .list)-entries.list"
        fi
    done
    for file in /etc/apt/sources.list.d/*.sources; do
        if [[ -f $file ]]; then
            sed -E 's/^[Tt]ypes:.*/Types: deb-src/' "$file" >"$1/$(basename "$file")"
        fi
    done
}

# Settings that keep everything apt does inside the folder $1 and switch off the hooks that touch the system's caches.
write_apt_settings() {
    cat >"$1/apt.conf" <<END
Dir::Etc::sourcelist "/dev/null";
Dir::Etc::sourceparts "$1/entries";
Dir::State::lists "$1/lists";
Dir::Cache::pkgcache "";
Dir::Cache::srcpkgcache "";
APT::Sandbox::User "root";
Acquire::Languages "none";
#clear APT::Update::Pre-Invoke;
#clear APT::Update::Post-Invoke;
#clear APT::Update::Post-Invoke-Success;
END
}

# Fetches the source package of the installed libode-dev into folder $1 and leaves the system's apt settings and caches alone.
fetch_ode_source() {
    local package work
    package=$(dpkg-query --show --showformat '${source:Package}=${source:Version}' libode-dev 2>/dev/null) ||
        fail "libode-dev is not installed as a package: set ODE_SOURCE_DIR to the folder of your ODE's source"
    say "Fetching the source of ODE (${package#*=})"
    mkdir -p "$(dirname "$1")"
    work=$(mktemp --directory --tmpdir="$(dirname "$1")")
    # shellcheck disable=SC2064 # the folder of this very call
    trap "rm -rf '$work'" EXIT
    mkdir -p "$work/entries" "$work/lists/partial" "$work/source"
    derive_source_entries "$work/entries"
    write_apt_settings "$work"
    apt-get --config-file "$work/apt.conf" --quiet update >&2
    (cd "$work/source" && apt-get --config-file "$work/apt.conf" --quiet --only-source source "$package" >&2) ||
        fail "apt has no source package $package: unpack the source yourself and set ODE_SOURCE_DIR to its folder"
    mv "$work"/source/*/ "$1"
    rm -rf "$work"
    trap - EXIT
}

find_ode_source() {
    if [[ -n ${ODE_SOURCE_DIR:-} ]]; then
        ode_source=$(cd "$ODE_SOURCE_DIR" 2>/dev/null && pwd) || fail "ODE_SOURCE_DIR ($ODE_SOURCE_DIR) is not a folder"
        return
    fi
    ode_source="$top/build/ode-source/ode-$(ode_version)"
    if [[ ! -d $ode_source ]]; then
        has apt-get || fail "there is no apt-get: unpack the source of ODE $(ode_version) and set ODE_SOURCE_DIR to its folder"
        fetch_ode_source "$ode_source"
    fi
}

# As find_ode_source, but the source is optional: ode_source is empty if it cannot be fetched.
want_ode_source() {
    if [[ -n ${ODE_SOURCE_DIR:-} ]] || (find_ode_source); then
        find_ode_source
    else
        ode_source=
        say "Continuing without ODE's source: the demo has no window, and tests that need the source are left out"
    fi
}

# build_ode <prefix> <options of cmake>: builds ODE once, with its own copy of libccd; Debian's package uses the system's.
build_ode() {
    local prefix=$1 ode_source log
    shift
    if [[ -f $prefix/lib/pkgconfig/ode.pc ]]; then
        return
    fi
    need library
    find_ode_source
    log="$prefix/build.log"
    say "Building ODE with $*; the output of the build is in $log"
    rm -rf "$prefix"
    mkdir -p "$prefix"
    # The build uses a copy: the source package has configured headers, which a build beside it would find first.
    cp -a "$ode_source" "$prefix/source"
    (
        cmake -S "$prefix/source" -B "$prefix/build" -G Ninja -DCMAKE_INSTALL_PREFIX="$prefix" -DCMAKE_INSTALL_LIBDIR=lib \
            -DCMAKE_CXX_COMPILER_LAUNCHER="$(command -v ccache || true)" -DODE_WITH_LIBCCD=ON \
            -DODE_WITH_DEMOS=OFF -DODE_WITH_TESTS=OFF "$@"
        cmake --build "$prefix/build" --target install
    ) >"$log" 2>&1 || fail "ODE could not be built: see $log"
}

# Only ODE's build type Debug has assertions.
build_ode_release() { build_ode "$1" -DCMAKE_BUILD_TYPE=Release -DODE_DOUBLE_PRECISION=ON; }

build_with_ode() {
    # The space compiles ODE's assertion macros, too; this definition removes them.
    configure -S . -B build/release-ode -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH="$1" \
        -DCMAKE_CXX_FLAGS=-DdNODEBUG -DODE_SOURCE_DIR=
    cmake --build build/release-ode --target "$2"
}
