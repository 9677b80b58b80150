#!/bin/sh
# Compiles each header of a folder of the prefix in a file of its own, with what pkg-config says. Nearly all of the time goes to
# reading Eigen: with "precompiled" that is read once, and a header that forgets to include Eigen or what it includes from the
# standard library is overlooked; "alone" overlooks nothing.
# Usage: compile_headers_alone.sh precompiled|alone <libdir of the prefix> <package> <includedir of the prefix> <folder in it>
#        <scratch folder> <compiler> <flags>
set -eu

manner=$1
PKG_CONFIG_PATH=$2/pkgconfig${PKG_CONFIG_PATH:+:$PKG_CONFIG_PATH}
export PKG_CONFIG_PATH
package=$3
includedir=$4
folder=$5
scratch=$6
shift 6

flags=$(pkg-config --cflags "$package")
eval "set -- \"\$@\" $flags"
mkdir -p "$scratch"
if [ "$manner" = precompiled ]; then
    echo '#include <Eigen/Geometry>' >"$scratch/eigen.h"
    "$@" -x c++-header "$scratch/eigen.h" -o "$scratch/eigen.h.gch"
    set -- "$@" -include "$scratch/eigen.h" -Wno-ignored-attributes # as Eigen asks for; the compiler does not keep it there
fi
failed=0
count=0
for header in "$includedir/$folder"/*.h; do
    count=$((count + 1))
    printf '#include <%s/%s>\n' "$folder" "$(basename "$header")" | "$@" -fsyntax-only -x c++ - || {
        failed=$((failed + 1))
        printf '%s does not compile alone\n' "$header"
    }
done
printf '%s headers, %s failed\n' "$count" "$failed"
[ -e "$header" ] && [ "$failed" -eq 0 ]
