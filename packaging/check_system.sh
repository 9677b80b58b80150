#!/usr/bin/env bash
# Builds in a fresh Debian of some release by GCC and the newest Clang, runs the tests of the contract, and checks the packages.
# Usage: check_system.sh <suite> <folder of the sources> <scratch folder>

set -euo pipefail

suite=$1
chroot=$3/$suite
# shellcheck source=chroot.sh
. "$(dirname "${BASH_SOURCE[0]}")/chroot.sh"

make_packages() {
    say "Building the packages and checking them by lintian"
    install_in_chroot build-essential debhelper dpkg-dev lintian libspnav-dev libx11-dev
    inside /tmp/sources/packaging/make_debian_packages.sh /tmp/sources /tmp/packages >"$chroot/tmp/packages.log" 2>&1 ||
        { tail -n 40 "$chroot/tmp/packages.log" && return 1; }
    inside sh -c 'lintian --fail-on error,warning /tmp/packages/*.changes'
    inside dpkg-query --show lintian
}

newest_clang() { inside apt-cache pkgnames clang- | sed -nE 's/^clang-([0-9]+)$/\1/p' | sort -n | tail -n 1; }

make_chroot "$suite"
copy_sources "$2"
clang=$(newest_clang)
install_in_chroot g++ "clang-$clang" cmake ninja-build pkg-config libode-dev libeigen3-dev libcli11-dev
show_versions g++ "clang-$clang" cmake libode-dev libeigen3-dev

build_with gcc gcc g++
build_consumers consumer_gcc -DCMAKE_PREFIX_PATH=/tmp/gcc/prefix
build_with clang "clang-$clang" "clang++-$clang"
build_consumers consumer_clang -DCMAKE_PREFIX_PATH=/tmp/clang/prefix -DCMAKE_C_COMPILER="clang-$clang" \
    -DCMAKE_CXX_COMPILER="clang++-$clang"

test_contract
make_packages
rm -rf "$chroot"
