#!/bin/sh
# Fails if the library exports other names than the headers declare, or one without a version. Exports for the launcher have a
# separate version node.
# Usage: compare_exports.sh <library> <header>...
set -eu

library=$1
shift
exported=$(nm --dynamic --defined-only "$library" |
    awk '$2 != "A" && $3 !~ /^__/ && $3 !~ /^ode_predictive_space_.*@@ODE_PREDICTIVE_SPACE_PRIVATE$/ { sub(/@@ODE_PREDICTIVE_SPACE_[0-9.]+$/, " versioned", $3); print $3 }' | sort)
declared=$(sed -nE 's/^ODE_PREDICTIVE_API .*[ *](d[A-Za-z]+)\(.*/\1 versioned/p' "$@" | sort)

if [ "$exported" != "$declared" ]; then
    printf 'exported:\n%s\n\ndeclared:\n%s\n' "$exported" "$declared"
    exit 1
fi
printf '%s names\n' "$(printf '%s\n' "$exported" | wc -l)"
