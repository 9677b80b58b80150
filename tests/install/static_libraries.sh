#!/usr/bin/env bash
# Builds and installs the static libraries, then builds programs with them by CMake and by pkg-config, and runs these. The
# shared libraries are installed beside them, as for users of both. Files are optimised across as in a release, but not
# otherwise, to save time.
# Usage: static_libraries.sh SOURCES SCRATCH_FOLDER C_COMPILER CXX_COMPILER

set -euo pipefail

sources=$1 work=$2 c=$3 cxx=$4
tests=$sources/tests/install
prefix=$work/prefix

# No program may be linked with the project's libraries at run time.
check_and_run() {
    local program
    for program in "$@"; do
        if readelf --dynamic --wide "$program" | grep 'NEEDED.*ode_predictive_space'; then
            printf '%s is not linked statically\n' "$program" >&2
            exit 1
        fi
        "$program"
    done
}

rm -rf "$prefix" "$work/consumer"
cmake -S "$sources" -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DODE_SOURCE_DIR= \
    -DCMAKE_CXX_FLAGS_RELEASE=-O0 -DODE_PREDICTIVE_SPACE_HARDENING=OFF -DODE_PREDICTIVE_SPACE_STATIC=ON -DODE_PREDICTIVE_SPACE_BUILD_TESTS=OFF -DODE_PREDICTIVE_SPACE_BUILD_DEMOS=OFF \
    -DCMAKE_C_COMPILER="$c" -DCMAKE_CXX_COMPILER="$cxx" -DCMAKE_INSTALL_PREFIX="$prefix" >/dev/null
cmake --build "$work/build"
cmake --install "$work/build" >/dev/null
libdir=$(dirname "$(find "$prefix" -name libode_predictive_space.a)")
for archive in "$libdir"/*.a; do
    if readelf --section-headers --wide "$archive" 2>/dev/null | grep --max-count 1 'gnu\.lto'; then
        printf '%s suits one version of one compiler\n' "$archive" >&2
        exit 1
    fi
done

cmake -S "$tests/static_consumer" -B "$work/consumer" -G Ninja -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_C_COMPILER="$c" \
    -DCMAKE_CXX_COMPILER="$cxx" >/dev/null
cmake --build "$work/consumer"
check_and_run "$work/consumer/consumer_c" "$work/consumer/consumer_haptics"

# Linkers prefer shared libraries.
rm "$libdir"/libode_predictive_space*.so*
export PKG_CONFIG_PATH=$libdir/pkgconfig${PKG_CONFIG_PATH:+:$PKG_CONFIG_PATH}
read -ra flags < <(pkg-config --static --cflags --libs ode_predictive_space)
"$c" -std=c89 -pedantic "$tests/consumer/consumer.c" -o "$work/consumer/c89" "${flags[@]}"
read -ra flags < <(pkg-config --static --cflags --libs ode_predictive_space_haptics)
"$cxx" -std=c++17 "$tests/consumer/consumer_haptics.cpp" -o "$work/consumer/haptics" "${flags[@]}"
check_and_run "$work/consumer/c89" "$work/consumer/haptics"
