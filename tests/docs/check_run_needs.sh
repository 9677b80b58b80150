#!/usr/bin/env bash
# What each command of `./run` installs and builds: no games for the tests, no tests for the demo, the promise tested first.
# Usage: check_run_needs.sh SOURCE_DIR

set -uo pipefail

# shellcheck source=run_without_doing.sh
. "$(dirname "${BASH_SOURCE[0]}")/run_without_doing.sh"
run_without_doing "$1"
wrong=0

# calls_of <arguments>: sets done_by to what `./run` called.
calls_of() {
    command=$*
    : >"$calls"
    "$copy/run" "$@" >/dev/null 2>&1
    done_by=$(<"$calls")
}

# has and lacks take an extended regular expression.
complain() {
    printf 'run %s: %s\n%s\n' "$command" "$1" "$done_by" >&2
    wrong=1
}
has() { grep --quiet --extended-regexp -- "$1" <<<"$done_by" || complain "nothing was called like '$1'"; }
lacks() { ! grep --quiet --extended-regexp -- "$1" <<<"$done_by" || complain "this was called: '$1'"; }
count() { [[ $(grep --count --extended-regexp -- "$2" <<<"$done_by") == "$1" ]] || complain "not $1 calls like '$2'"; }

games='mokomaze|mu-cade|stormbaancoureur|libompl|dartpy|pyode'

calls_of hello
has 'apt-get install .*libode-dev'
lacks 'libcli11|libgtest|dpkg-dev|libgl'
lacks 'apt-get .*source'

calls_of demo --objects 30
has 'apt-get install .*libcli11-dev'
lacks "libgtest|libbenchmark|libbullet|valgrind|matplotlib|$games"
has 'cmake -S . -B build/demo .*BUILD_TESTS=OFF'
has 'cmake --build build/demo --target predictive_haptic_demo'
count 1 'cmake --build'

# After ./run build or ./run test it is there.
mkdir -p "$copy/build/release"
: >"$copy/build/release/build.ninja"
calls_of demo --objects 30
has 'cmake --build --preset release --target predictive_haptic_demo'
lacks 'build/demo'
rm -r "$copy/build/release"

calls_of test
lacks "$games"
count 1 'apt-get update'
has 'cmake .*TEST_CLIENTS=OFF .*TEST_LONG=OFF'
done_by=$(sed '/^ctest/q' "$calls") # up to the first test
has 'cmake --build --preset release --target tests_of_contract'
has 'ctest .*--label-regex \^contract\$'
lacks 'libgl|matplotlib|valgrind|xvfb|libbullet|apt-get .*source'
count 1 'cmake --build'
done_by=$(sed '1,/^ctest/d' "$calls") # after it
has 'cmake --build --preset release --target all'
has 'ctest .*--label-exclude \^\(long\|contract\)\$'

calls_of test --with-clients
for game in mokomaze mu-cade stormbaancoureur libompl-dev python3-dartpy python3-pyode; do
    has "apt-get install .*$game"
done
has 'cmake .*TEST_CLIENTS=ON'

calls_of package
has 'apt-get install .*libode-dev'
lacks "libgtest|lintian|mmdebstrap|$games"
has 'apt-get install .*debhelper'
has 'make_debian_packages\.sh'

# What the benchmark prints can be kept in a file: nothing of its build is in it.
for ode in installed release; do
    command="bench --ode $ode"
    done_by=$("$copy/run" bench --ode "$ode" 2>/dev/null)
    [[ -z $done_by ]] || complain 'what is built is in the output'
done

# What asks for certain tests gets them, in one go.
calls_of test --preset asan --long -R Contract
count 1 '^ctest'
has 'ctest --preset asan .* -R Contract'
has 'cmake .*TEST_LONG=ON'
lacks 'label-exclude'
exit $wrong
