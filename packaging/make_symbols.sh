#!/bin/sh
# Writes the file of symbols of a package with a library.
# Usage: make_symbols.sh <dpkg-gensymbols> <package> <version> <library> <template> <file>
set -eu

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
# It wants a source package around.
mkdir "$folder/debian"
printf 'Source: ode-predictive-space\n\nPackage: %s\nArchitecture: any\n' "$2" >"$folder/debian/control"
mkdir -p "$folder/build/usr/lib" "$folder/build/DEBIAN"
cp "$4" "$folder/build/usr/lib"
(cd "$folder" && "$1" -c4 -q -p"$2" -v"$3" -Pbuild -I"$5" -O"$6" "-ebuild/usr/lib/$(basename "$4")")
