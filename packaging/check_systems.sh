#!/usr/bin/env bash
# Builds and tests the project in fresh Debians: bookworm, trixie, testing, and oldest, which has the oldest tools.
# Usage: check_systems.sh <folder of the sources> <scratch folder> [system...]

set -euo pipefail

here=$(dirname "${BASH_SOURCE[0]}")
systems=("${@:3}")
((${#systems[@]} > 0)) || systems=(bookworm trixie testing oldest)
for system in "${systems[@]}"; do
    if [[ $system == oldest ]]; then
        "$here/check_oldest.sh" "$1" "$2"
    else
        "$here/check_system.sh" "$system" "$1" "$2"
    fi
done
