#!/usr/bin/env bash
# Configures the project without packages that the libraries do not need: CMake reports these packages and no others.
# Usage: configure_without.sh PACKAGE,... SCRATCH_DIR CMAKE OPTION...

set -euo pipefail

IFS=, read -ra packages <<<"$1"
scratch=$2
rm -rf "$scratch"
mkdir -p "$scratch"
"$3" -B "$scratch" -DODE_SOURCE_DIR= "${packages[@]/#/-DCMAKE_DISABLE_FIND_PACKAGE_}" "${@:4}" | tee "$scratch/output"
reported=$(sed -nE "s/^-- ([A-Za-z0-9_]+) \(Debian's [a-z0-9-]+\) is missing: .* left out$/\1/p" "$scratch/output" | sort -u)
diff <(printf '%s\n' "${packages[@]%=ON}" | sort) <(printf '%s\n' "$reported")
