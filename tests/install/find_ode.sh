#!/usr/bin/env bash
# Is the ODE of each precision found where a distribution has a library and a pkg-config file for each? In made-up prefixes.
# Usage: find_ode.sh SCRATCH_FOLDER FOLDER_OF_FINDODE C_COMPILER

set -euo pipefail

scratch=$1 modules=$2 c=$3
here=$(dirname "${BASH_SOURCE[0]}")
rm -rf "$scratch"

# make_ode <prefix> <name> <flags in its pkg-config file>: headers that serve both precisions, and a library.
make_ode() {
    local prefix=$scratch/$1 name=$2
    mkdir -p "$prefix/include/ode" "$prefix/lib/pkgconfig"
    printf '%s\n' '#if defined(dIDEDOUBLE)' '#define dDOUBLE' '#elif !defined(dDOUBLE)' '#define dSINGLE' '#endif' \
        'int precision_of_ode(void);' >"$prefix/include/ode/ode.h"
    echo '#define dODE_VERSION "0.16.2"' >"$prefix/include/ode/version.h"
    echo 'int precision_of_ode(void) { return 0; }' | "$c" -shared -fPIC -x c - -o "$prefix/lib/lib$name.so"
    [[ $# -lt 3 ]] || printf '%s\n' "prefix=$prefix" 'libdir=${prefix}/lib' "Name: $name" 'Description: an ODE' 'Version: 0.16.2' \
        "Libs: -L\${libdir} -l$name" "Cflags: -I\${prefix}/include $3" >"$prefix/lib/pkgconfig/$name.pc"
}

# expect <folder> <precision> <library> <options of cmake>: a program of this precision is built, with this library.
expect() {
    PKG_CONFIG_LIBDIR=$scratch/$1/lib/pkgconfig cmake -S "$here/find_ode" -B "$scratch/build/$((++count))" -G Ninja \
        -DCMAKE_C_COMPILER="$c" -DMODULES="$modules" -DPRECISION="$2" "${@:4}" >"$scratch/said"
    grep -q -- "-- $3\$" "$scratch/said" || { cat "$scratch/said" && return 1; }
    cmake --build "$scratch/build/$count" >"$scratch/said" || { cat "$scratch/said" && return 1; }
}
count=0

make_ode double ode-double -DdDOUBLE
expect double dDOUBLE "$scratch/double/lib/libode-double.so of ode-double"

make_ode both ode -DdIDESINGLE
make_ode both ode-double '-DdIDEDOUBLE -DUNRELATED'
expect both dSINGLE "$scratch/both/lib/libode.so of ode"
expect both dDOUBLE "$scratch/both/lib/libode-double.so of ode-double" -DODE_PKG_CONFIG_NAMES=ode-double

# The definition is for the library that pkg-config describes, not for another one.
make_ode alone ode
expect double dSINGLE "$scratch/alone/lib/libode.so of ode-double" -DODE_LIBRARY="$scratch/alone/lib/libode.so"
printf '%s programs\n' "$count"
