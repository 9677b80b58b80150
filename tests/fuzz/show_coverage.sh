#!/usr/bin/env bash
# Replays the corpus of the space and later finds, and shows how many lines of the libraries they reach.
# Usage: show_coverage.sh <folder of the build> <folder of the finds>

set -euo pipefail

build=$1 found=$2
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
mkdir -p "$found"
printf -- '-- Replaying the corpus and what is in %s\n' "$found"
LLVM_PROFILE_FILE=$build/space.profraw "$build/tests/fuzz/space_replay" "$found" "$top/tests/fuzz/corpus/space" | tail -n 1
llvm-profdata merge -o "$build/space.profdata" "$build/space.profraw"
llvm-cov report "$(readlink -f "$build/ode_predictive_space/libode_predictive_space.so")" -instr-profile="$build/space.profdata" \
    -show-region-summary=false -show-branch-summary=false "$top/ode_predictive_space"
