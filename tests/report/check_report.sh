#!/usr/bin/env bash
# check_report.sh DAMSLIP CHROMIUM SCENE: makes the screening report of the scene and opens it in a headless browser.
# Fails when the page's script reports an error, a chart is not drawn or empty, or the console says anything.
# With "#check" in its address the page unfolds all parts and looks for the colour of a curve in each chart (page.js).
set -euo pipefail
damslip=$1 chromium=$2 scene=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$damslip" screen "$scene" --out "$work/out" >"$work/stdout" 2>"$work/talk" || { cat "$work/talk"; exit 1; }
page="$work/out/report.html"
[ "$(tail -n 1 "$work/talk")" = "report: $page" ] || { echo "the last line of the talk does not name the report:"; cat "$work/talk"; exit 1; }

timeout 90 "$chromium" --headless --no-sandbox --disable-gpu --disable-background-networking --user-data-dir="$work/profile" \
    --enable-logging=stderr --window-size=1100,900 --virtual-time-budget=4000 --dump-dom "file://$page#check" >"$work/dom" 2>"$work/log" ||
    { echo "the browser failed:"; tail -n 5 "$work/log"; exit 1; }

mark=$(grep -o '<div id="drawn"[^>]*>' "$work/dom" || true)
value() { sed -n "s/.*data-$1=\"\([^\"]*\)\".*/\1/p" <<<"$mark"; }
echo "$mark"
status=0
fail() { echo "FAIL: $1"; status=1; }
[ "$(value state)" = drawn ] || fail "state is '$(value state)', errors: $(value errors)"
[ -n "$(value charts)" ] && [ "$(value charts)" -ge 8 ] || fail "fewer than 8 charts"
[ "$(value drawn)" = "$(value charts)" ] || fail "charts not drawn"
grep -q 'data-empty=""' <<<"$mark" || fail "empty charts: $(value empty)"
if grep CONSOLE "$work/log"; then fail "the console is not silent"; fi
exit $status
