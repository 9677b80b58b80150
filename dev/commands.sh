# The commands of `./run dev`, which includes this file and has the functions that it calls.
# shellcheck shell=bash

# draw <script> [arguments]: uses the system's Python, because another one in PATH may have no matplotlib.
draw() {
    need plots
    PATH=/usr/bin:$PATH exec python3 "$@"
}

dev_command() {
    local ode_source
    case $1 in
    clients)
        need clients
        build release all -DODE_PREDICTIVE_SPACE_TEST_CLIENTS=ON
        exec tests/clients/table --build build/release "${@:2}"
        ;;
    patched)
        need "${everything[@]}" autotools
        find_ode_source
        exec tests/patched_ode/check "${@:2}" "$ode_source" build/patched-ode
        ;;
    mingw)
        need library mingw
        find_ode_source
        exec tests/mingw/check "$ode_source" build/mingw
        ;;
    variants)
        # shellcheck source=tests/variants/variants.sh
        . tests/variants/variants.sh
        test_variants "${@:2}"
        ;;
    package)
        need library package "${2:+chroot}"
        packaging/make_debian_packages.sh . build/package
        [[ -z ${2:-} ]] || exec packaging/check_in_chroot.sh build/package . build/chroot
        ;;
    systems)
        need chroot
        exec packaging/check_systems.sh . build/systems "${@:2}"
        ;;
    fuzz)
        build fuzz fuzzers
        exec tests/fuzz/search.sh build/fuzz "${2:-60}"
        ;;
    coverage)
        build coverage space_replay
        exec tests/fuzz/show_coverage.sh build/coverage build/fuzz/found/space
        ;;
    mutations)
        need "${everything[@]}"
        find_ode_source
        exec python3 -B tests/mutations/run_mutations.py --ode-source "$ode_source" "${@:2}"
        ;;
    plots) draw docs/plots/plots.py ;;
    drawings) draw docs/drawings/draw.py ;;
    docs)
        need docs
        docs/doxygen/make build/docs && say "Begin with build/docs/html/index.html"
        ;;
    tidy)
        build tidy all
        exec run-clang-tidy -quiet -j "$(nproc)" -p build/tidy -extra-arg=-Wno-ignored-optimization-argument \
            "$top/(ode_predictive_space|tests|demos)/.*"
        ;;
    *) misused "there is no command 'dev $1'; ./run help lists them" ;;
    esac
}
