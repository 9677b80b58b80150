#!/usr/bin/env bash
# Builds and installs the project with a static ODE, then builds programs with the package as with any other, and runs them: the
# space, the haptics library and ODE are in the programs.
# Usage: static_ode.sh SOURCES SCRATCH_FOLDER C_COMPILER CXX_COMPILER ODE_ARCHIVE

set -euo pipefail

sources=$1 work=$2 c=$3 cxx=$4 archive=$5
prefix=$work/prefix

configure() { cmake -S "$1" -B "$2" -G Ninja -DODE_LIBRARY="$archive" -DCMAKE_C_COMPILER="$c" -DCMAKE_CXX_COMPILER="$cxx" "${@:3}" >/dev/null; }

rm -rf "$prefix" "$work/consumer"
configure "$sources" "$work/build" -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE=-O0 -DODE_SOURCE_DIR= \
    -DODE_PREDICTIVE_SPACE_HARDENING=OFF -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=20 \
    -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON
cmake --build "$work/build"
cmake --install "$work/build" --prefix "$prefix" >/dev/null

configure "$sources/tests/install/consumer" "$work/consumer" -DCMAKE_PREFIX_PATH="$prefix"
cmake --build "$work/consumer"
for program in consumer_c consumer_cxx consumer_haptics; do
    if readelf --dynamic --wide "$work/consumer/$program" | grep 'NEEDED.*ode'; then
        printf '%s is not linked statically\n' "$program" >&2
        exit 1
    fi
    "$work/consumer/$program"
done
