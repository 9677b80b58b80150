#!/bin/sh
# Runs the program in simulated time, in which all runs must be the same, and by the clock.
# Usage: check_haptic_hello.sh <program>
set -eu

fail() {
    printf '%s, in:\n%s\n' "$1" "$simulated"
    exit 1
}

expect() {
    printf '%s\n' "$simulated" | grep -Eq "$1" || fail "no line like \"$1\""
}

simulated=$("$1" simulated)
[ "$simulated" = "$("$1" simulated)" ] || fail 'the second run differs'

# A grip of 300 N/m aims 2 cm deep into a wall of 500 N/m: two springs in series, at 3.75 N.
expect '^0\.1 s: the probe at 0\.16.. m touches nothing, the force is 0\.00 N$'
expect '^1\.0 s: the probe at 0\.102. m touches the box, the force is 3\.7. N$'
expect '^1000 ticks '
[ "$(printf '%s\n' "$simulated" | wc -l)" -eq 11 ] || fail 'more or less than ten lines and a summary'

# On a busy machine the force by the clock may differ, but the box is touched at the end.
by_the_clock=$("$1") || { printf 'by the clock it fails:\n%s\n' "$by_the_clock"; exit 1; }
printf '%s\n' "$by_the_clock" | grep -q '^1000 ticks '
