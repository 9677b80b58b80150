#!/bin/sh
# The pages of the public headers are made without a warning and contain the text of the headers. A warning is an error.
# Usage: check_api_pages.sh SOURCE_DIR
set -eu

work=$(mktemp --directory)
trap 'rm -rf "$work"' EXIT

fail() {
    printf '%s\n' "$*" >&2
    exit 1
}

"$1/docs/doxygen/make" "$work/pages"

# has PAGE PATTERN: the text of the page, without marks, line ends and double spaces, must match.
has() {
    sed 's/<[^>]*>//g; s/&#160;/ /g; s/&gt;/>/g; s/&lt;/</g' "$work/pages/html/$1" | tr -s '\n ' '  ' | grep --quiet -e "$2" ||
        fail "$1 does not have: $2"
}

has index.html 'predicts when two geoms can come near each other'
has group__predictive__space.html 'dPredictiveSpaceCreate (dSpaceID parent) Create a predictive space'
has group__predictive__space.html 'parent *the space that will contain it, or 0'
has group__predictive__space.html 'Returns *the space, to be destroyed with dSpaceDestroy()'
has group__predictive__space.html 'dPredictiveProximityShape *when the shapes may touch'
has structdPredictiveSpaceStats.html 'pairs now in the near set'
has classdPredictiveSpace.html 'See dPredictiveSpaceSetHorizon()'
has namespaceode__predictive__space_1_1haptics.html 'make_device'
