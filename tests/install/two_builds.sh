#!/usr/bin/env bash
# Two builds in two folders make the same shared libraries, byte by byte, whatever the folder, the time and the order of work.
# Usage: two_builds.sh SOURCES SCRATCH_FOLDER C_COMPILER CXX_COMPILER

set -euo pipefail

sources=$1 work=$2 c=$3 cxx=$4
# shellcheck source=../../packaging/source_files.sh
. "$sources/packaging/source_files.sh"

# build_and_install <folder>: without ccache, which would give the second build the files of the first one.
build_and_install() {
    rm -rf "$1"
    copy_source_files "$sources" "$1/sources"
    cmake -S "$1/sources" -B "$1/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DODE_SOURCE_DIR= -DCCACHE_PROGRAM= \
        -DODE_PREDICTIVE_SPACE_BUILD_TESTS=OFF -DODE_PREDICTIVE_SPACE_BUILD_DEMOS=OFF -DCMAKE_UNITY_BUILD=ON \
        -DCMAKE_UNITY_BUILD_BATCH_SIZE=20 -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON -DCMAKE_C_COMPILER="$c" \
        -DCMAKE_CXX_COMPILER="$cxx" >/dev/null
    cmake --build "$1/build" >/dev/null
    cmake --install "$1/build" --prefix "$1/prefix" >/dev/null
}

build_and_install "$work/one"
build_and_install "$work/another/of_a_longer_name"
count=0
while read -r -d '' file; do
    cmp "$file" "$work/another/of_a_longer_name/${file#"$work/one/"}"
    count=$((count + 1))
done < <(find "$work/one/prefix" -type f -print0)
# The libraries, the launcher's, and the tool.
find "$work/one/prefix" -name 'libode_predictive_space*.so*' -type f | grep -q haptics
printf '%s files are the same\n' "$count"
