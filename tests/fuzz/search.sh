#!/usr/bin/env bash
# Runs each fuzz target for some seconds, starting with its corpus and earlier finds. Failing inputs are left in the folder.
# Usage: search.sh <folder of the build> <seconds>

set -euo pipefail

build=$1 seconds=$2
corpus=$(dirname "${BASH_SOURCE[0]}")/corpus
for target in space contacts history recording settings; do
    longest=1601
    [[ $target != history ]] || longest=6000
    mkdir -p "$build/found/$target"
    printf -- '-- Fuzzing %s for %s s\n' "$target" "$seconds"
    # After an abort of ODE a scene stays locked and cannot be freed, so there is no search for leaks.
    ASAN_OPTIONS=detect_leaks=0 "$build/tests/fuzz/${target}_fuzzer" -max_total_time="$seconds" -max_len="$longest" \
        -timeout=120 -detect_leaks=0 -print_final_stats=1 -verbosity=0 -artifact_prefix="$build/$target-" \
        "$build/found/$target" "$corpus/$target" || {
        printf '%s fails with the bytes in %s-*\n' "$target" "$build/$target" >&2
        exit 1
    }
done
