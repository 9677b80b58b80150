#!/usr/bin/env bash
# Can programs that were built with the library as it was go on with the one that is built now? Compares its binary interface,
# as far as the public headers declare it, with the one in the file. What is new does no harm; anything else fails.
# With --renew, writes the file.
# Usage: compare_interface.sh [--renew] ABIDW ABIDIFF LIBRARY HEADERS FILE

set -euo pipefail

renew=
if [[ $1 == --renew ]]; then
    renew=yes
    shift
fi
abidw=$1 abidiff=$2 library=$3 headers=$4 file=$5

now=$(mktemp --suffix=.abi)
trap 'rm -f "$now"' EXIT
# Without paths and lines, and without the types that are not in the headers.
"$abidw" --headers-dir "$headers" --drop-private-types --no-show-locs --no-comp-dir-path --no-corpus-path --out-file "$now" \
    "$library"
if [[ -n $renew ]]; then
    cp "$now" "$file"
    exit
fi
if ! "$abidiff" --no-added-syms "$file" "$now"; then
    printf '%s\n' "Programs that were built with the library as it was may not run with this one. If that has to be, renew" \
        "$(basename "$file") by building the target renew_abi, and say why in the commit." >&2
    exit 1
fi
grep -c '<elf-symbol ' "$now" | sed 's/$/ symbols as before/'
