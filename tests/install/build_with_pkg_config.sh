#!/bin/sh
# Builds a program with what pkg-config says, and runs it.
# Usage: build_with_pkg_config.sh <libdir of the prefix> <program> <compiler> <flags and sources>
set -eu

PKG_CONFIG_PATH=$1/pkgconfig${PKG_CONFIG_PATH:+:$PKG_CONFIG_PATH}
export PKG_CONFIG_PATH
libdir=$1
program=$2
shift 2

# pkg-config quotes its output for a shell to read.
flags=$(pkg-config --cflags --libs ode_predictive_space)
eval "set -- \"\$@\" $flags"
"$@" -o "$program" -Wl,-rpath,"$libdir"
exec "$program"
