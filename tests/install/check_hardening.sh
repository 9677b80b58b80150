#!/usr/bin/env bash
# Were the libraries built with the options that make a mistake harder to exploit?
# Usage: check_hardening.sh READELF LIBRARY...

set -euo pipefail

readelf=$1
shift
weak=0

# check <library> <what> <pattern> <options of readelf>
check() {
    local found
    found=$("$readelf" --wide "${@:4}" "$1")
    if ! grep -qE "$3" <<<"$found"; then
        printf '%s: %s\n' "$1" "$2" >&2
        weak=1
    fi
}

for library in "$@"; do
    check "$library" "the table of addresses stays writable (no RELRO)" 'GNU_RELRO' --program-headers
    check "$library" "symbols are bound late (no NOW)" '\(FLAGS\).*BIND_NOW|\(FLAGS_1\).*NOW' --dynamic
    check "$library" "no function guards its stack" '__stack_chk_fail' --dyn-syms
    if "$readelf" --wide --dyn-syms "$library" | grep -E ' (sn?|f)printf(@|$)'; then
        printf '%s: it writes text by functions that do not check the length (no _FORTIFY_SOURCE)\n' "$library" >&2
        weak=1
    fi
    check "$library" "its stack may be executed" 'GNU_STACK.* RW ' --program-headers
done
exit $weak
