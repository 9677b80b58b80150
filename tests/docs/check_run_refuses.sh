#!/usr/bin/env bash
# `./run` refuses command lines that it does not understand: exit code 2, one line, and nothing is installed or built for them.
# Usage: check_run_refuses.sh RUN

set -uo pipefail

run=$1
wrong=0

# refuses <arguments>
refuses() {
    local output code
    output=$("$run" "$@" 2>&1)
    code=$?
    if ((code != 2)) || [[ $output == *$'\n'* ]]; then
        printf './run %s: exit code %s, "%s"\n' "$*" "$code" "$output" >&2
        wrong=1
    fi
}

refuses nonsense
refuses hello again
refuses build everything
refuses test --preset
refuses bench --ode
refuses bench --ode newest
refuses fuzz never
refuses plots
refuses format --all
refuses tidy first
exit $wrong
