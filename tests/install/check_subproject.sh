#!/usr/bin/env bash
# The sources as a part of another project: its build makes the library of the space and nothing else of ours, and its installation
# has nothing of ours unless ODE_PREDICTIVE_SPACE_INSTALL is on.
# Usage: check_subproject.sh SCRATCH_FOLDER [--build] CMAKE OPTION...

set -euo pipefail

scratch=$1
shift
build=false
if [[ $1 == --build ]]; then
    build=true
    shift
fi
rm -rf "$scratch"

configure() { "${command[@]}" -G Ninja -DCMAKE_BUILD_TYPE=Release -DODE_SOURCE_DIR= -B "$@" >/dev/null; }
command=("$@")

# made <folder>: the libraries and programs of ours that a build of everything links.
made() { ninja -C "$1" -t commands all | sed -nE 's/.* -o ([^ ]+) .*/\1/p' | grep -v '\.o$' | sort -u; }

fail() {
    printf '%s\n' "$@" >&2
    exit 1
}

configure "$scratch/build"
expected='ode_predictive_space/ode_predictive_space/libode_predictive_space.so.* program'
actual=$(made "$scratch/build" | tr '\n' ' ')
# shellcheck disable=SC2053 # a pattern
[[ $actual == $expected' ' ]] || fail "everything is: $actual"
objects=$(ninja -C "$scratch/build" -t commands all | grep -cE ' -o [^ ]+\.o ')
((objects <= 8)) || fail "$objects files are compiled"
if $build; then
    ninja -C "$scratch/build" >/dev/null
    "$scratch/build/program" >/dev/null
else
    touch "$scratch/build/program" # CMake would miss it, not the libraries
fi
cmake --install "$scratch/build" --prefix "$scratch/prefix" >/dev/null
[[ ! -e $scratch/prefix ]] || fail "installed without being asked:" "$(find "$scratch/prefix" -type f)"

# With haptics: they are made for a program that needs them. Asked for, all is installed.
configure "$scratch/more" -DWITH_HAPTICS=ON -DODE_PREDICTIVE_SPACE_INSTALL=ON
[[ $(made "$scratch/more") == *libode_predictive_space_haptics.so* ]] || fail "the haptics library is not made"
for file in libode_predictive_space.so libode_predictive_space_haptics.so ode_predictive_space-config.cmake predictive_space.h; do
    grep -rq --include=cmake_install.cmake "$file" "$scratch/more" || fail "$file would not be installed"
done
printf '%s\n' "$objects files are compiled"
