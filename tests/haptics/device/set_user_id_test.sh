#!/usr/bin/env bash
# A set-user-ID program does not follow SPNAV_SOCKET; the same program without set-user-ID does. The test needs the superuser,
# because it runs a file of one user as another one.
# Usage: set_user_id_test.sh PROGRAM

set -euo pipefail

folder=$(mktemp --directory)
trap 'rm -rf "$folder"' EXIT
chmod 755 "$folder"
export SPNAV_SOCKET=$folder/none.sock

# expect <mode of the program> <text>
expect() {
    local output
    install --mode="$1" "$program" "$folder/program"
    output=$(setpriv --reuid=65534 --regid=65534 --clear-groups "$folder/program")
    if [[ $output != *"$2"* ]]; then
        printf 'mode %s: "%s" instead of "%s"\n' "$1" "$output" "$2" >&2
        exit 1
    fi
}

program=$1
# The other user may have no access to the folder of the build.
ldd "$program" | awk '$1 ~ /^libode/ { print $3 }' | xargs --no-run-if-empty cp --dereference --target-directory="$folder"
find "$folder" -type f -exec chmod 755 {} + # there may be none
export LD_LIBRARY_PATH=$folder # a set-user-ID program does not follow this either
expect 0755 "$SPNAV_SOCKET: No such file"
expect 4755 "SPNAV_SOCKET is set, which a set-user-ID program ignores: unset it"
