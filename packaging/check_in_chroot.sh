#!/usr/bin/env bash
# Tries the packages as a stranger would: in a new Debian with ODE's own packages alone, builds the sources with GCC and with
# Clang; installs the packages, builds programs with them, runs the launcher; removes the packages and looks for what they left.
# Root is needed, and mmdebstrap; /proc has to be as in a usual system.
# Usage: check_in_chroot.sh <folder of the packages> <folder of the sources> <scratch folder>

set -euo pipefail

packages=$1
sources=$2
chroot=$3/root

say() { printf '==> %s\n' "$*"; }

# Of Debian's packages, as the system gets them.
entries() {
    # shellcheck disable=SC2016 # apt fills them in
    apt-get indextargets --format 'deb $(REPO_URI) $(RELEASE) $(COMPONENT)' 'Created-By: Packages' 'Origin: Debian' | sort -u
}

inside() { chroot "$chroot" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive "$@"; }

install_in_chroot() { inside apt-get -q install --yes --no-install-recommends "$@" >/dev/null; }

# Every file that packages bring or make, without what apt itself keeps.
list_files() {
    (cd "$chroot" && find . -xdev \( -path ./tmp -o -path ./proc -o -path ./sys -o -path ./dev -o -path ./var/cache -o \
        -path ./var/log -o -path ./var/lib/apt \) -prune -o -print | sort)
}

build_with() {
    say "The sources, built by $1 with libode-dev alone"
    inside cmake -S /tmp/sources -B "/tmp/$1" -G Ninja -DCMAKE_BUILD_TYPE=Release -DODE_PREDICTIVE_SPACE_BUILD_TESTS=OFF \
        -DODE_PREDICTIVE_SPACE_BUILD_DEMOS=OFF -DCMAKE_C_COMPILER="$2" -DCMAKE_CXX_COMPILER="$3" >/dev/null
    inside ninja -C "/tmp/$1" | tail -n 1
    inside cmake --install "/tmp/$1" --prefix "/tmp/$1/prefix" >/dev/null
}

# The packages on which a package of a program would depend, as dpkg-shlibdeps says.
list_dependencies() {
    say 'What a package with the programs would depend on'
    mkdir -p "$chroot/tmp/program/debian"
    printf 'Source: program\n\nPackage: program\nArchitecture: any\n' >"$chroot/tmp/program/debian/control"
    inside sh -c 'cd /tmp/program && dpkg-shlibdeps -O -e/tmp/consumer/consumer_c -e/tmp/consumer/consumer_haptics' |
        tee "$chroot/tmp/depends"
    grep -q 'libode-predictive-space0 (>= 0\.1\.0)' "$chroot/tmp/depends"
    grep -q 'libode-predictive-space-haptics0 (>= 0\.1\.0)' "$chroot/tmp/depends"
}

# The copyright of each package names the licence that is in the sources.
check_licences() {
    local package
    # shellcheck disable=SC2016 # dpkg fills it in
    for package in $(inside dpkg-query --show --showformat '${Package}\n' 'libode-predictive-space*'); do
        grep -q '^License: BSD-3-Clause' "$chroot/usr/share/doc/$package/copyright"
    done
}

build_programs() {
    say 'Programs, built with the packages by CMake and by pkg-config'
    inside cmake -S /tmp/sources/tests/install/consumer -B /tmp/consumer -G Ninja >/dev/null
    inside ninja -C /tmp/consumer | tail -n 1
    inside ctest --test-dir /tmp/consumer --output-on-failure
    inside sh -c 'c++ -std=c++17 -O2 /tmp/sources/demos/beside_ode.cpp -o /tmp/beside_ode $(pkg-config --cflags --libs \
        ode_predictive_space)'
}

run_launcher() {
    say 'The launcher'
    inside ode-predictive-run --stats /tmp/beside_ode >"$chroot/tmp/launcher" 2>&1
    grep 'hash, predictive by boxes' "$chroot/tmp/launcher"
}

rm -rf "$chroot"
mkdir -p "$3"
say 'A new Debian'
entries | mmdebstrap --quiet --variant=apt --include=ca-certificates "$(. /etc/os-release && printf '%s' "$VERSION_CODENAME")" \
    "$chroot" -
mkdir -p "$chroot/tmp/sources" "$chroot/tmp/packages"
git -C "$sources" ls-files -z | tar -C "$sources" --null --files-from=- --create | tar -C "$chroot/tmp/sources" --extract
cp "$packages"/*.deb "$chroot/tmp/packages"
inside apt-get -q update >/dev/null
install_in_chroot g++ dpkg-dev clang cmake ninja-build pkg-config libode-dev libeigen3-dev
list_files >"$3/before"

build_with gcc gcc g++
build_with clang clang clang++
say 'Installing'
inside sh -c 'apt-get -q install --yes --no-install-recommends /tmp/packages/*.deb' >/dev/null
list_files | comm -13 "$3/before" - >"$3/installed"
check_licences
build_programs
list_dependencies
run_launcher
say 'Removing'
inside sh -c "apt-get -q purge --yes --auto-remove '^libode-predictive-space.*'" >/dev/null
list_files | diff "$3/before" -
say "$(wc -l <"$3/installed") files and folders were installed, and none is left"
rm -rf "$chroot"
