#!/bin/sh
# Compiles each header of a folder of the prefix alone, with pkg-config's flags. Nearly all of the time is for reading Eigen.
# Usage: compile_headers_alone.sh <package> <includedir of the prefix> <folder in it> <compiler> <flags>
set -eu

package=$1
includedir=$2
folder=$3
shift 3

flags=$(pkg-config --cflags "$package")
eval "set -- \"\$@\" $flags"
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
