#!/usr/bin/env bash
# Builds Debian's source and binary packages in the version of CMakeLists.txt. DEBFULLNAME and DEBEMAIL name their maintainer.
# Usage: make_debian_packages.sh <folder of the sources> <folder for the packages, which is emptied>

set -euo pipefail
# shellcheck source=source_files.sh
. "$(dirname "${BASH_SOURCE[0]}")/source_files.sh"

sources=$1 output=$2
version=$(sed -nE 's/^ +VERSION ([0-9.]+)$/\1/p' "$sources/CMakeLists.txt")
name=ode-predictive-space
# Without an address the packages are for tests only: by definition, mail to this one goes nowhere.
maintainer="${DEBFULLNAME:-ode_predictive_space developers} <${DEBEMAIL:-nobody@ode-predictive-space.invalid}>"

rm -rf "$output"
mkdir -p "$output"
output=$(cd "$output" && pwd)
copy_source_files "$sources" "$output/$name-$version"
tar -C "$output" --exclude-vcs --create --gzip --file "$output/${name}_$version.orig.tar.gz" "$name-$version"
cp -r "$output/$name-$version/packaging/debian" "$output/$name-$version/debian"
sed -i "s/@MAINTAINER@/$maintainer/" "$output/$name-$version/debian/control"
# A package of Debian itself, whose revisions begin with 1, would replace these.
cat >"$output/$name-$version/debian/changelog" <<END
$name ($version-0upstream1) unstable; urgency=medium

  * Packages of version $version, made by its developers.

 -- $maintainer  $(time_of_sources "$sources")
END
cd "$output/$name-$version"
DEB_BUILD_OPTIONS="${DEB_BUILD_OPTIONS:+$DEB_BUILD_OPTIONS }noautodbgsym" dpkg-buildpackage --no-sign
rm -rf "${output:?}/$name-$version"
