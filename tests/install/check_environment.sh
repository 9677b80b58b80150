#!/usr/bin/env bash
# Do the libraries read the environment only by secure_getenv(), which finds nothing in a set-user-ID program?
# Usage: check_environment.sh READELF LIBRARY...

set -euo pipefail

readelf=$1
shift
for library in "$@"; do
    symbols=$("$readelf" --wide --dyn-syms "$library")
    if grep -qE ' (getenv|environ|__environ)(@|$)' <<<"$symbols"; then
        printf '%s reads the environment of any program\n' "$library" >&2
        exit 1
    fi
    if ! grep -qE ' secure_getenv(@|$)' <<<"$symbols"; then
        printf '%s does not read the environment: look at what this test is for\n' "$library" >&2
        exit 1
    fi
done
