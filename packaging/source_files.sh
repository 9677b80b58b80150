# Functions that list and copy the project's files, for scripts that include this one.
# shellcheck shell=bash

# source_files <folder>: prints the files that git tracks or, in an unpacked archive, all but built ones, each with a final 0.
source_files() {
    if [[ -e $1/.git ]]; then
        git -C "$1" ls-files -z
    else
        (cd "$1" && find . -path ./build -prune -o \( -type f -o -type l \) -printf '%P\0')
    fi
}

copy_source_files() {
    mkdir -p "$2"
    source_files "$1" | tar -C "$1" --null --files-from=- --create | tar -C "$2" --extract
}

# time_of_sources <folder>: prints the time of the last commit or of the archive in the format of mail.
time_of_sources() {
    if [[ -e $1/.git ]]; then
        git -C "$1" log -1 --format=%cD
    else
        date --rfc-email --reference="$1/CMakeLists.txt"
    fi
}
