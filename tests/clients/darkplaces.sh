#!/usr/bin/env bash
# Runs a server of the game engine DarkPlaces for some seconds with predictive spaces, and compares each collide with all pairs.
# Usage: darkplaces.sh TOOL SERVER SCRATCH_FOLDER

set -euo pipefail

tool=$1 server=$2 work=$3
rm -rf "$work"
mkdir -p "$work/game" "$work/home"
/usr/bin/python3 "$(dirname "$0")/darkplaces_game.py" "$work/game"

# It goes on until it is stopped: then timeout ends with 124.
status=0
"$tool" run --stats --record "$work/recording" timeout --signal INT --kill-after 30 8 "$server" -basedir "$work/game" -userdir "$work/home" \
    -noudp +sv_public 0 +physics_ode 1 +map room.obj </dev/null >"$work/output" 2>&1 || status=$?
((status == 124))
grep -a -A 4 '^ode_predictive_space' "$work/output"
grep -a -q 'quadtree, predictive by boxes; at most 61 geoms' "$work/output"
"$tool" replay --pairs --space box "$work/recording" | tee "$work/replayed"
grep -q 'The program got the pairs of simple spaces in all of its [1-9]' "$work/replayed"
