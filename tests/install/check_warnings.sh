#!/bin/sh
# Do the headers in the prefix warn in programs with more warnings than the library's own build has? All are compiled in C++17,
# 20 and 23, and the C header in C89, C99 and C11. Warnings in foreign headers are ignored.
# Usage: check_warnings.sh <includedir of the prefix> <C compiler> <C++ compiler>
set -eu

includedir=$1
c=$2
cxx=$3

others=$(pkg-config --cflags eigen3 ode | sed 's/-I/-isystem /g')
flags="$others -I$includedir -fsyntax-only -pedantic -Wall -Wextra -Wconversion -Wsign-conversion -Wshadow -Werror"
headers=$(cd "$includedir" && find ode_predictive_space -name '*.h' -o -name '*.hpp' | sort)
lines=$(printf '#include <%s>\n' $headers)
for standard in c++17 c++20 c++2b; do
    printf '%s\n' "$lines" | "$cxx" -std=$standard -Wold-style-cast $flags -x c++ -
done
for standard in c89 c99 c11; do
    echo '#include <ode_predictive_space/predictive_space.h>' | "$c" -std=$standard -Wstrict-prototypes $flags -x c -
done
printf '%s headers\n' "$(printf '%s\n' "$lines" | wc -l)"
