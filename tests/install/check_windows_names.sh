#!/bin/sh
# Do the headers in the prefix compile after windows.h? That header defines macros without a prefix, which erase or replace every name
# that is the same. The macros are defined here, after the headers of others, which have to bear them by themselves.
# Usage: check_windows_names.sh <includedir of the prefix> <C compiler> <C++ compiler>
set -eu

includedir=$1
c=$2
cxx=$3

others=$(pkg-config --cflags eigen3 ode | sed 's/-I/-isystem /g')
flags="$others -I$includedir -fsyntax-only -Werror"

macros() {
    printf '#define %s\n' near far pascal cdecl IN OUT OPTIONAL 'interface struct' 'small char' 'hyper long' 'ERROR 0' \
        'DELETE 1' 'NO_ERROR 0' 'STRICT 1' 'TRANSPARENT 1' 'RELATIVE 1' 'ABSOLUTE 2' 'IGNORE 0' 'INFINITE -1' 'grp1 1' 'DIFFERENCE 11'
}

# compile <compiler> <header>...: first what they include of others, then the macros, then they.
compile() {
    compiler=$1
    shift
    {
        (cd "$includedir" && sed -nE '/#include <ode_predictive_space/d; s/^# *include (<.*>)/#include \1/p' "$@" | sort -u)
        macros
        printf '#include <%s>\n' "$@"
    } | $compiler $flags -
}

compile "$c -std=c99 -x c" ode_predictive_space/predictive_space.h ode_predictive_space/history.h
# shellcheck disable=SC2046 # no header has a blank in its name
compile "$cxx -std=c++17 -x c++" $(cd "$includedir" && find ode_predictive_space -name '*.h' -o -name '*.hpp' | sort)
