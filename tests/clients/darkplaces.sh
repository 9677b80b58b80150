#!/usr/bin/env bash
# Runs a server of the game engine DarkPlaces for some seconds with predictive spaces, and compares each collide with all pairs.
# Usage: darkplaces.sh TOOL SERVER SCRATCH_FOLDER

set -euo pipefail

tool=$1 server=$2 work=$3
rm -rf "$work"
mkdir -p "$work/game" "$work/home"
/usr/bin/python3 "$(dirname "$0")/darkplaces_game.py" "$work/game"

# The server runs until a signal ends it: timeout ends with 124, and there is a recording but no statistics.
status=0
"$tool" run --record "$work/recording" timeout --signal INT --kill-after 30 8 "$server" -basedir "$work/game" -userdir "$work/home" \
    -noudp +sv_public 0 +physics_ode 1 +map room.obj </dev/null >"$work/output" 2>&1 || status=$?
((status == 124))
"$tool" replay --pairs --space own --space box "$work/recording" | tee "$work/replayed"
grep -q '^own (quadtree)' "$work/replayed"
grep -q 'The program got the pairs of simple spaces in all of its [1-9]' "$work/replayed"
