#!/usr/bin/env bash
# Can programs that were built with the recorded library run with the present one? Compares its symbols and the types of its
# public headers with those in BASELINE.symbols and BASELINE.abi.gz. Additions are allowed; anything else fails. A changed
# return type is noticed for functions of the space only. With --renew, writes the two files.
# Usage: compare_interface.sh ABIDW ABIDIFF LIBRARY LIBRARY_WITH_TYPES HEADERS BASELINE [--renew]

set -euo pipefail

abidw=$1 abidiff=$2 library=$3 types=$4 headers=$5 baseline=$6
work=$(mktemp --directory)
trap 'rm -rf "$work"' EXIT

nm --dynamic --defined-only --format=posix "$library" | awk '$2 != "A" { print $1 }' | LC_ALL=C sort >"$work/symbols"
# Paths, lines, and types that are not in the headers are left out.
"$abidw" --headers-dir "$headers" --drop-private-types --no-show-locs --no-comp-dir-path --no-corpus-path \
    --out-file "$work/abi" "$types"

if [[ ${7:-} == --renew ]]; then
    cp "$work/symbols" "$baseline.symbols"
    gzip -9 --no-name --stdout "$work/abi" >"$baseline.abi.gz"
    exit
fi
changed=0
LC_ALL=C comm -23 "$baseline.symbols" "$work/symbols" | sed 's/@@.*//' | c++filt | sed 's/^/gone: /' | tee "$work/gone"
[[ ! -s $work/gone ]] || changed=1
gunzip --stdout "$baseline.abi.gz" >"$work/before.abi"
"$abidiff" --no-added-syms "$work/before.abi" "$work/abi" || changed=1
if ((changed)); then
    printf '%s\n' "Programs that were built with the library as it was may not run with this one. If that has to be, renew" \
        "the files by building the target renew_abi, and say why in the commit." >&2
    exit 1
fi
printf '%s symbols, no fewer than before\n' "$(wc -l <"$work/symbols")"
