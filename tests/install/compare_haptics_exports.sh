#!/usr/bin/env bash
# Does the haptics library export what its public headers declare, and nothing else? Its exports are listed by hand.
# Usage: compare_haptics_exports.sh LIBRARY HEADERS LIST

set -euo pipefail

library=$1 headers=$2 list=$3
namespace=ode_predictive_space::haptics

# The classes and functions of the namespace, without templates and inline functions.
declared=$(awk '
    FNR == 1 { inside = 0 }
    /^namespace / { inside = 1 }
    !inside { next }
    /^(class|struct) [A-Za-z]+/ && !/;$/ { print $2; next }
    /^[A-Za-z].*\(/ && !/^(inline|constexpr|template|using|static_assert)/ && match($0, /[a-z_0-9]+\(/) {
        print substr($0, RSTART, RLENGTH - 1)
    }' "$headers"/*.h | sort -u)
listed=$(sed -nE "s/^ +(\*\?for\?)?$namespace::([A-Za-z_0-9]+).*;/\2/p" "$list" | sort -u)
diff <(printf '%s\n' "$declared") <(printf '%s\n' "$listed") || {
    printf '%s does not list what the headers declare\n' "$list" >&2
    exit 1
}

# Nested classes of public classes are private here: only functions and tables are visible.
exported=$(nm --dynamic --defined-only --demangle "$library" | sed -nE 's/^[0-9a-f]+ [^A] (.*)@@.*/\1/p' |
    sed -E 's/^(vtable|typeinfo|typeinfo name|VTT|non-virtual thunk to|virtual thunk to) (for )?//' | sort -u)
abi='(\[abi:cxx11\])?'
if grep -vE "^$namespace::([A-Z][A-Za-z]*(::~?[A-Za-z_]+$abi\(.*|::operator.*|::[a-z_]+)?|[a-z_0-9]+$abi\(.*)$" <<<"$exported"; then
    printf 'exported, but not the name of something public\n' >&2
    exit 1
fi
names=$(sed -E "s/^$namespace::([A-Za-z_0-9]+).*/\1/" <<<"$exported" | sort -u)
if comm -23 <(printf '%s\n' "$names") <(printf '%s\n' "$declared") | grep .; then
    printf 'exported, but not declared in a public header\n' >&2
    exit 1
fi
printf '%s symbols of %s classes and functions\n' "$(wc -l <<<"$exported")" "$(wc -l <<<"$names")"
