#!/usr/bin/env bash
# Opens the pages that a program writes with --report in headless Chromium: no console message, no external content, plots with
# points. Exit status 77 without Chromium: CTest shows the test as skipped.
# Usage: check_page.sh PLOTS COMMAND...
#  PLOTS     the headings that the page must have, separated by ';'
#  COMMAND   writes the page when `--report FOLDER` replaces the word REPORT

set -euo pipefail

browser=$(command -v chromium || command -v chromium-browser) || {
    printf 'NOT TESTED: there is no chromium\n' >&2
    exit 77
}
plots=$1
shift
work=$(mktemp --directory)
trap 'rm -rf "$work"' EXIT

fail() {
    printf 'FAILED: %s\n' "$*" >&2
    exit 1
}

command=()
for word in "$@"; do
    if [[ $word == REPORT ]]; then command+=(--report "$work/page"); else command+=("$word"); fi
done
"${command[@]}" >"$work/output" 2>&1 || fail "status $?: $(<"$work/output")"

# Chromium's sandbox does not work as root.
HOME=$work timeout 120 "$browser" --headless --no-sandbox --disable-gpu --disable-dev-shm-usage \
    --user-data-dir="$work/profile" --enable-logging=stderr --dump-dom "file://$work/page/index.html" \
    >"$work/dom" 2>"$work/log" || fail "chromium: $(tail -5 "$work/log")"

if grep CONSOLE "$work/log"; then fail "messages on the console"; fi
if grep -E '://|<(script|link|img|iframe)|@import|url\(' "$work/page/index.html"; then fail "something is not in the page"; fi

# name <tab> points of each plot, as the browser has parsed it
awk -F'"' '
    /<h2>/ { title = $0; gsub(/.*<h2>|<\/h2>.*/, "", title) }
    /<polyline/ { points[title] += split($(NF - 1), pairs, " ") }
    /<circle/ { ++points[title] }
    /<\/svg>/ { print title "\t" points[title] + 0 }' "$work/dom" >"$work/plots"
while IFS= read -r -d ';' plot; do
    count=$(awk -F'\t' -v title="$plot" '$1 == title { print $2 }' "$work/plots")
    ((${count:-0} > 1)) || fail "$plot: ${count:-no plot} points; the page has: $(<"$work/plots")"
    printf '%s: %s points\n' "$plot" "$count"
done <<<"$plots;"
