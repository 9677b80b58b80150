#!/usr/bin/env bash
# `./run` refuses command lines that it does not understand: exit code 2, one line, and nothing is installed or built for them.
# So it does with the demo's options, and no command's --help needs a build either.
# Usage: check_run_refuses.sh SOURCE_DIR DEMO BENCHMARK; the last two are built programs, or empty

set -uo pipefail

source=$1
demo=${2:-}
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

# demo_refuses <arguments>: `./run`, and the demo itself.
demo_refuses() {
    refuses demo "$@"
    if [[ -n $demo ]] && "$demo" "$@" >/dev/null 2>&1; then
        complain "The demo itself accepts: $*"
    fi
}

# demo_accepts <arguments>: they get past the check; what comes after it finds nothing to run.
demo_accepts() {
    local output
    output=$("$copy/run" demo "$@" 2>&1)
    if ! grep --quiet '^cmake --build' "$calls"; then
        complain "run demo $* built nothing: \"$output\""
    fi
    : >"$calls"
}

refuses nonsense
refuses hello again
refuses build everything
refuses test --preset
refuses bench --ode
refuses bench --ode newest
refuses bench soup
refuses fuzz never
refuses coverage all
refuses variants msvc
refuses package everything
refuses plots
refuses drawings path
refuses docs latex
refuses format --all
refuses tidy first

demo_refuses everything
demo_refuses --object 30
demo_refuses --objects
demo_refuses --objects many
demo_refuses --objects 0
demo_refuses --objects=100001
demo_refuses --objects 2.5
demo_refuses --seed x
demo_refuses --seconds 0.001
demo_refuses --rate 99
demo_refuses --law magnetism
demo_refuses --scene
demo_refuses --space octree
demo_refuses --space predictive,octree
demo_refuses --space hash sap octree
demo_refuses --headless 7 --fast
demo_refuses --headless=maybe
demo_refuses --compare --device virtual
demo_refuses --space predictive,hash --fast
demo_refuses --headless --screenshot picture.png
demo_refuses --replay a.txt --device virtual
demo_refuses --screenshot picture.png --seconds 0.5
demo_refuses --device sponge --headless

demo_accepts
demo_accepts --device mouse --objects 300
demo_accepts --headless --device virtual --seconds 10
demo_accepts --scene pile --space hash --law proxy --stiffness 8e2
demo_accepts --compare --objects=100 --seconds 5
demo_accepts --space predictive,hash sap --json results.json
demo_accepts --device replay:a.txt --fast
demo_accepts --screenshot picture.png --seconds 2 --at 1.5

# explains <command>: its help is there without anything that is installed or built.
explains() {
    local help
    help=$("$copy/run" "$1" --help 2>&1) || complain "run $1 --help fails: $help"
    [[ -n $help ]] || complain "run $1 --help says nothing"
    if [[ -s $calls ]]; then
        complain "run $1 --help called: $(<"$calls")"
        : >"$calls"
    fi
}

# has_help_of <command> <file> <program>: the file is what the program says, which `./run` prints without it. The program is called
# by a short name, as its help wraps lines.
has_help_of() {
    [[ $("$copy/run" "$1" --help) == "$(<"$2")" ]] || complain "run $1 --help does not print $2"
    if [[ -n $3 ]]; then
        (cd "$(dirname "$3")" && "./$(basename "$3")" --help) | sed "s|^Usage: [^ ]*|Usage: ./run $1|" | diff "$2" - >&2 || complain "$2 is not what $3 --help prints"
    fi
}

while read -r command; do
    explains "$command"
done < <("$copy/run" help | awk '/^$/ { ++part } part == 1 && /^  [a-z]/ { print $1 }')
has_help_of demo "$source/demos/haptic/help.txt" "$demo"
has_help_of bench "$source/tests/benchmarks/help.txt" ""
exit $wrong
