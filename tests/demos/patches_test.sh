#!/usr/bin/env bash
# Tests patches/apply on a copy of ODE's source: apply and undo, twice each; a source that does not fit is left alone.
# Usage: patches_test.sh <patches/apply> <source of ODE>

set -euo pipefail

apply=$1
source=$2
work=$(mktemp --directory)
trap 'rm -rf "$work"' EXIT

fail() {
    printf 'FAILED: %s\n' "$*" >&2
    exit 1
}

# succeeds_saying, fails_saying <text> <command...>: the command succeeds or fails, and its output contains the text.
succeeds_saying() {
    "${@:2}" >"$work/said" 2>&1 && grep -q "$1" "$work/said"
}
fails_saying() {
    ! "${@:2}" >"$work/said" 2>&1 && grep -q "$1" "$work/said"
}

cp -r "$source" "$work/tree"
# The source may have been patched in place.
"$apply" --undo "$work/tree"
cp -r "$work/tree" "$work/pristine"

"$apply" "$work/tree"
grep -q dsSetPointerCallback "$work/tree/include/drawstuff/drawstuff.h" || fail "the patch is not in the tree"
cp -r "$work/tree" "$work/patched"
succeeds_saying 'applied already' "$apply" "$work/tree" drawstuff-pointer.patch || fail "a second time should say so"
diff -r "$work/tree" "$work/patched" || fail "a second time changes something"

"$apply" --undo "$work/tree"
diff -r "$work/tree" "$work/pristine" || fail "undone is not as it was"
succeeds_saying 'was not applied' "$apply" --undo "$work/tree" || fail "undoing a second time should say so"

sed -i 's/^static void handleEvent/static  void handleEvent/' "$work/tree/drawstuff/src/x11.cpp"
cp -r "$work/tree" "$work/changed"
"$apply" "$work/tree" && fail "it fits a changed source"
diff -r "$work/tree" "$work/changed" || fail "what does not fit changes something"

sed -i 's/^AC_INIT(.*/AC_INIT([ODE],[9.9.9])/' "$work/tree/configure.ac"
fails_saying 'has ODE 9.9.9' "$apply" "$work/tree" || fail "it takes another version"
fails_saying 'not a source tree of ODE' "$apply" "$work" || fail "it takes any folder"
printf 'passed\n'
