#!/bin/sh
# Fails if a class of the headers in the prefix has another size or alignment in programs that are compiled for AVX or AVX-512.
# Only GCC can list all classes.
# Usage: compare_layouts.sh <package> <includedir of the prefix> <scratch folder> <compiler> <flags>
set -eu

package=$1
includedir=$2
scratch=$3
shift 3

flags=$(pkg-config --cflags "$package")
eval "set -- \"\$@\" $flags"
rm -rf "$scratch"
mkdir -p "$scratch"
cd "$scratch"
(cd "$includedir" && find ode_predictive_space -name '*.h' -o -name '*.hpp') | sort | sed 's/.*/#include <&>/' >headers.cpp

# layouts <name> <flags>: writes "class size alignment" lines to the file of that name.
layouts() {
    name=$1
    shift
    "$@" -fsyntax-only -fdump-lang-class="$name.dump" headers.cpp
    awk '$1 == "Class" && $2 ~ /^(ode_predictive_space|dPredictive)/ { name = $2; getline; print name, $1, $2 }' \
        "$name.dump" | sort >"$name"
}

layouts plain "$@"
layouts avx "$@" -mavx
layouts avx512 "$@" -mavx512f -mfma
grep -q 'ode_predictive_space::haptics::DeviceState' plain
diff plain avx
diff plain avx512
printf '%s classes\n' "$(wc -l <plain)"
