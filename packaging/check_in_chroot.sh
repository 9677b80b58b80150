#!/usr/bin/env bash
# Checks the packages with lintian; in a fresh Debian, installs, uses and removes them, and looks for remaining files.
# Usage: check_in_chroot.sh <folder of the packages> <folder of the sources> <scratch folder>

set -euo pipefail

packages=$1
sources=$2
chroot=$3/root

# shellcheck source=chroot.sh
. "$(dirname "${BASH_SOURCE[0]}")/chroot.sh"

# Lists the files that packages bring or make, without those that apt keeps.
list_files() {
    (cd "$chroot" && find . -xdev \( -path ./tmp -o -path ./proc -o -path ./sys -o -path ./dev -o -path ./var/cache -o \
        -path ./var/log -o -path ./var/lib/apt \) -prune -o -print | sort)
}

list_dependencies() {
    say 'The dependencies that a package with the programs would have'
    mkdir -p "$chroot/tmp/program/debian"
    printf 'Source: program\n\nPackage: program\nArchitecture: any\n' >"$chroot/tmp/program/debian/control"
    inside sh -c 'cd /tmp/program && dpkg-shlibdeps -O -e/tmp/programs/consumer/consumer_c \
        -e/tmp/programs/consumer/consumer_haptics' |
        tee "$chroot/tmp/depends"
    grep -q 'libode-predictive-space0.1 (>= 0\.1\.0)' "$chroot/tmp/depends"
    grep -q 'libode-predictive-space-haptics0.1 (>= 0\.1\.0)' "$chroot/tmp/depends"
}

check_licences() {
    local package
    # shellcheck disable=SC2016 # dpkg fills it in
    for package in $(inside dpkg-query --show --showformat '${Package}\n' 'libode-predictive-space*'); do
        grep -q '^License: BSD-3-Clause' "$chroot/usr/share/doc/$package/copyright"
    done
}

# Runs the tests that the source package has for installed packages (autopkgtest).
test_installed() {
    say 'Building programs with the packages by CMake and by pkg-config, and running the launcher'
    mount --bind /proc "$chroot/proc" # the tool finds its libraries from its own path
    trap 'umount "$chroot/proc"' EXIT
    inside sh -c 'mkdir /tmp/programs && cd /tmp/sources && AUTOPKGTEST_TMP=/tmp/programs packaging/debian/tests/programs'
    umount "$chroot/proc"
    trap - EXIT
}

lintian --fail-on error,warning "$packages"/*.changes
make_chroot "$(. /etc/os-release && printf '%s' "$VERSION_CODENAME")"
copy_sources "$sources"
mkdir -p "$chroot/tmp/packages"
cp "$packages"/*.deb "$chroot/tmp/packages"
install_in_chroot g++ dpkg-dev cmake ninja-build pkg-config libode-dev libeigen3-dev
list_files >"$3/before"

say 'Installing the packages'
inside sh -c 'apt-get -q install --yes --no-install-recommends /tmp/packages/*.deb' >/dev/null
list_files | comm -13 "$3/before" - >"$3/installed"
check_licences
test_installed
list_dependencies
say 'Removing the packages'
inside sh -c "apt-get -q purge --yes --auto-remove '^libode-predictive-space.*'" >/dev/null
list_files | diff "$3/before" -
say "$(wc -l <"$3/installed") files and folders were installed, and all of them were removed"
rm -rf "$chroot"
