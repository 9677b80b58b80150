#!/usr/bin/env bash
# `./run` refuses command lines that it does not understand: exit code 2, one line, and nothing is installed or built for them.
# Only the demo's --help needs a build.
# Usage: check_run_refuses.sh SOURCE_DIR

set -uo pipefail

source=$1
wrong=0

# shellcheck source=run_without_doing.sh
. "$(dirname "${BASH_SOURCE[0]}")/run_without_doing.sh"
run_without_doing "$source"

complain() {
    printf '%s\n' "$*" >&2
    wrong=1
}

# refuses <arguments>
refuses() {
    local output code
    output=$("$copy/run" "$@" 2>&1)
    code=$?
    if ((code != 2)) || [[ $output == *$'\n'* ]]; then
        complain "run $*: exit code $code, \"$output\""
    fi
    if [[ -s $calls ]]; then
        complain "run $* called: $(<"$calls")"
        : >"$calls"
    fi
}

refuses nonsense
refuses clients
refuses dev nonsense
refuses test --preset
refuses bench --ode
refuses bench --ode newest
refuses dev fuzz never
refuses dev variants msvc
refuses dev plots cost.svg
refuses format --all
refuses dev tidy first

# explains <command...>: its help needs no installation and no build.
explains() {
    local help
    help=$("$copy/run" "$@" --help 2>&1) || complain "run $* --help fails: $help"
    [[ -n $help ]] || complain "run $* --help says nothing"
    if [[ -s $calls ]]; then
        complain "run $* --help called: $(<"$calls")"
        : >"$calls"
    fi
}

# The demo prints its help itself.
while read -r command subcommand _; do
    [[ $command == dev ]] || subcommand=
    [[ $command == demo ]] || explains "$command" $subcommand
done < <("$copy/run" help | grep -E '^  [a-z]')
[[ $("$copy/run" bench --help) == "$(<"$source/tests/benchmarks/help.txt")" ]] || complain "run bench --help does not print its help"
exit $wrong
