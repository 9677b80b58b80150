#!/usr/bin/env bash
# Checks the oldest supported tools, GCC 11, Eigen 3.3 and CMake 3.22, in Debian 12 with an older CMake in place of 3.22.
# Usage: check_oldest.sh <folder of the sources> <scratch folder>

set -euo pipefail

chroot=$2/oldest
# shellcheck source=chroot.sh
. "$(dirname "${BASH_SOURCE[0]}")/chroot.sh"

required='cmake_minimum_required(VERSION 3.22)'

make_chroot bookworm
entries bullseye >"$chroot/etc/apt/sources.list.d/older.list"
inside apt-get -q update >/dev/null
install_in_chroot g++-11 make ninja-build pkg-config libode-dev cmake/bullseye cmake-data/bullseye libeigen3-dev/bullseye
show_versions g++-11 cmake libode-dev libeigen3-dev
copy_sources "$1"
grep --recursive --files-with-matches --fixed-strings "$required" "$chroot/tmp/sources" |
    xargs sed -i "s/$required/${required/22/18}/"

# Before 3.21, CMake does not say whether the project is a part of another one.
compilers=(-DPROJECT_IS_TOP_LEVEL=ON -DCMAKE_C_COMPILER=gcc-11 -DCMAKE_CXX_COMPILER=g++-11)
build_with gcc gcc-11 g++-11 "${compilers[@]}"
build_consumers consumer_gcc -DCMAKE_PREFIX_PATH=/tmp/gcc/prefix "${compilers[@]}"
test_contract "${compilers[@]}"
rm -rf "$chroot"
