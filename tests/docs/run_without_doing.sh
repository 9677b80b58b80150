# For tests of `./run`: a copy of it with stand-ins for its tools, which record their calls, print a line and do nothing.
# Usage, in a script: . run_without_doing.sh; run_without_doing SOURCE_DIR; "$copy/run" ...; the calls are in $calls

# Sets copy to a folder with `run` and its files, and calls to the file of the recorded calls. `run` finds no package installed.
run_without_doing() {
    local source=$1 tool
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
}
