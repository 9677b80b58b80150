#!/bin/sh
# Builds a program with the flags of pkg-config, and runs it.
# Usage: build_with_pkg_config.sh <libdir of the prefix> <package> <program> <compiler> <flags and sources>
set -eu

libdir=$1
package=$2
program=$3
shift 3

# pkg-config quotes its output for a shell to read.
flags=$(pkg-config --cflags --libs "$package")
eval "set -- \"\$@\" $flags"
"$@" -o "$program" -Wl,-rpath,"$libdir"
exec "$program"
