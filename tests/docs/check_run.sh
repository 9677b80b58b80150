#!/usr/bin/env bash
# Checks `./run` in a copy, with stand-ins for its tools, which record their calls, print a line and do nothing:
# - which packages each command installs and which targets it builds: no games for the tests, no tests for the demo, the promise
#   tested first; and that it names the packages and asks before;
# - that it refuses command lines that it does not understand: exit code 2, one line, and nothing is installed or built for them.
# Usage: check_run.sh SOURCE_DIR

set -uo pipefail

source=$1
wrong=0

work=$(mktemp --directory)
trap 'rm -rf "$work"' EXIT
copy=$work/copy
calls=$work/calls
mkdir -p "$copy/ode_predictive_space/cmake" "$copy/tests" "$work/tools"
cp -r "$source"/{run,dev} "$copy/"
cp "$source/ode_predictive_space/cmake/ode_source.sh" "$copy/ode_predictive_space/cmake/"
cp -r "$source"/tests/{benchmarks,clients,mutations,patched_ode,variants} "$copy/tests/"
mkdir "$copy/packaging"
printf '#!/bin/sh\necho "$0 $*" >>"%s"\n' "$calls" >"$copy/packaging/make_debian_packages.sh"
chmod +x "$copy/packaging/make_debian_packages.sh"
for tool in apt-get apt-cache cmake ctest sudo c++ ninja dpkg-query pkg-config; do
    cat >"$work/tools/$tool" <<TOOL
#!/bin/sh
case $tool in
sudo) exec "\$@" ;;
dpkg-query) [ "\$2" = '--showformat=\${source:Package}=\${source:Version}' ]; exit ;;
pkg-config) echo 0.16.2; exit ;;
apt-cache) exit ;;
esac
echo "$tool \$*" >>"$calls"
echo "$tool is at work"
TOOL
    chmod +x "$work/tools/$tool"
done
PATH=$work/tools:$PATH
unset ODE_SOURCE_DIR
: >"$calls"

# calls_of <arguments>: sets done_by to the calls that `./run` makes.
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

# refuses <arguments>: exit code 2 and one line, and nothing is called.
refuses() {
    local code
    command=$*
    : >"$calls"
    done_by=$("$copy/run" "$@" 2>&1)
    code=$?
    if ((code != 2)) || [[ $done_by == *$'\n'* ]]; then
        complain "exit code $code, or several lines"
    fi
    [[ ! -s $calls ]] || complain "this was called: $(<"$calls")"
}

refuses nonsense
refuses clients
refuses dev nonsense
refuses test --preset
refuses bench --ode
refuses bench --ode newest
refuses dev fuzz never
refuses dev variants msvc
refuses dev plots cost.svg
refuses format --all
refuses dev tidy first

# explains <command...>: its help needs no installation and no build.
explains() {
    command="$* --help"
    : >"$calls"
    done_by=$("$copy/run" "$@" --help 2>&1) || complain 'this fails'
    [[ -n $done_by ]] || complain 'this says nothing'
    [[ ! -s $calls ]] || complain "this was called: $(<"$calls")"
}

# The demo prints its help itself.
while read -r command subcommand _; do
    [[ $command == dev ]] || subcommand=
    [[ $command == demo ]] || explains "$command" $subcommand
done < <("$copy/run" help | grep -E '^  [a-z]')
command='bench --help' done_by=$("$copy/run" bench --help)
[[ $done_by == "$(<"$source/tests/benchmarks/help.txt")" ]] || complain 'this is not its help'

games='mokomaze|mu-cade|stormbaancoureur|libompl|dartpy|pyode'

calls_of hello
has 'apt-get install .*libode-dev'
has 'cmake -S . -B build/hello .*BUILD_TESTS=OFF'
has 'cmake --build build/hello --target ode_predictive_space'
has 'apt-get install .*libcli11-dev' # the tutorial also uses the tool
lacks 'libgtest|dpkg-dev|libgl'
lacks 'apt-get .*source'

calls_of demo --objects 30
has 'apt-get install .*libcli11-dev'
lacks "libgtest|libbenchmark|libbullet|valgrind|matplotlib|$games"
has 'cmake -S . -B build/demo .*BUILD_TESTS=OFF'
has 'cmake --build build/demo --target predictive_haptic_demo'
count 1 'cmake --build'

calls_of test
lacks "$games|clang|matplotlib|valgrind"
count 1 'apt-get install'
has 'cmake .*TEST_CLIENTS=OFF .*TEST_LONG=OFF'
done_by=$(sed '/^ctest/q' "$calls") # up to the first test
has 'cmake --build --preset release --target tests_of_contract'
has 'ctest .*--label-regex \^contract\$'
count 1 'cmake --build'
done_by=$(sed '1,/^ctest/d' "$calls") # after it
has 'cmake --build --preset release$'
has 'ctest .*--label-exclude \^\(none\|long\|contract\)\$'

calls_of test --with-clients
for game in mokomaze mu-cade stormbaancoureur libompl-dev python3-dartpy python3-pyode; do
    has "apt-get install .*$game"
done
has 'cmake .*TEST_CLIENTS=ON'

calls_of dev package
has 'apt-get install .*libode-dev'
lacks "libbenchmark|lintian|mmdebstrap|$games"
has 'apt-get install .*debhelper'
has 'make_debian_packages\.sh'

# The output of the benchmark can be kept in a file: it contains nothing of the build.
for ode in "" "--ode release"; do
    command="bench $ode"
    # shellcheck disable=SC2086 # two words or none
    done_by=$("$copy/run" bench $ode 2>/dev/null)
    [[ -z $done_by ]] || complain 'what is built is in the output'
done

calls_of test --preset asan --long -R Contract
count 1 '^ctest'
has 'ctest --preset asan .* -R Contract'
has 'cmake .*TEST_LONG=ON'
has 'label-exclude \^\(none\)\$'
has 'apt-get install .*clang'

# Packages are named before they are installed. Without a terminal there is no question; on one, the user decides.
command=hello
done_by=$("$copy/run" hello 2>&1 >/dev/null </dev/null)
has '^-- Packages to install with apt-get: .*libode-dev'
lacks 'Install them'
answered() {
    : >"$calls"
    done_by=$(printf '%s\n' "$1" | env --unset=CI script --quiet --return --command "$copy/run hello" /dev/null 2>&1; cat "$calls")
    has 'Install them\? \[Y/n\]'
}
if command -v script >/dev/null; then
    answered n
    lacks '^apt-get install'
    answered y
    has '^apt-get install'
fi

# Without apt, a sentence names what is missing, and the packages that have it.
mkdir "$work/bare"
for tool in bash dirname env grep; do
    ln -s "$(command -v "$tool")" "$work/bare/$tool"
done
for arguments in hello demo build test; do
    command=$arguments
    done_by=$(PATH=$work/bare "$copy/run" "$arguments" 2>&1)
    has '^run: missing: c\+\+ cmake ninja pkg-config ODE; .* libode-dev .* ode-devel .* ode for pacman'
    count 1 .
done
exit $wrong
