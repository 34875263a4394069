#!/usr/bin/env bash
# check_report.sh CHROMIUM LEAST_CHARTS LARGEST_BYTES DAMSLIP COMMAND SCENE [OPTION ...]: makes the report of `damslip COMMAND SCENE
# OPTION ...` and opens it in a headless browser. Fails when the page's script reports an error, a chart or picture is not drawn or
# empty, a slider, choice or key has no effect (interact.html), there are fewer charts than LEAST_CHARTS, the file is too large, or the console says anything.
# Labels that cover each other or are cut off, and a section that does not fit the screen, fail too. WIDTH: of the page, a window's where it is not given [px].
# With "#check" in its address the page unfolds all parts and looks for the colour of a curve in each chart (page.js).
set -euo pipefail
chromium=$1 least=$2 largest=$3 damslip=$4 command=$5
shift 5
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

flag=--out
if [ "$command" = sweep ]; then out="$work/out/results.csv" page="$work/out/results.html"; mkdir "$work/out"
elif [ "$command" = explain ]; then flag=--report out="$work/out/ablation.html" page="$work/out/ablation.html"
else out="$work/out" page="$work/out/report.html"; fi
"$damslip" "$command" "$@" "$flag" "$out" >"$work/stdout" 2>"$work/talk" || { cat "$work/talk"; exit 1; }
[ "$(tail -n 1 "$work/talk")" = "report: $page" ] || { echo "the last line of the talk does not name the report:"; cat "$work/talk"; exit 1; }

cat "$page" "$(dirname "$0")/interact.html" >"$work/copy.html"
opened="$work/copy.html#check" budget=4000
if [ -n "${WIDTH:-}" ]; then # no window is as narrow as a telephone: a frame is
    cat >"$work/frame.html" <<FRAME
<iframe src="copy.html#check" style="width: ${WIDTH}px; height: 900px"></iframe>
<script>setTimeout(() => document.body.append(document.querySelector("iframe").contentDocument.getElementById("drawn").cloneNode()), 6000)</script>
FRAME
    opened="$work/frame.html" budget=9000
fi
timeout 90 "$chromium" --headless --no-sandbox --disable-gpu --disable-background-networking --user-data-dir="$work/profile" \
    --allow-file-access-from-files --enable-logging=stderr --window-size=1100,900 --virtual-time-budget="$budget" --dump-dom "file://$opened" >"$work/dom" 2>"$work/log" ||
    { echo "the browser failed:"; tail -n 5 "$work/log"; exit 1; }

mark=$(grep -o '<div id="drawn"[^>]*>' "$work/dom" || true)
value() { sed -n "s/.*data-$1=\"\([^\"]*\)\".*/\1/p" <<<"$mark"; }
echo "$mark"
status=0
fail() { echo "FAIL: $1"; status=1; }
[ "$(value state)" = drawn ] || fail "state is '$(value state)', errors: $(value errors)"
[ -n "$(value charts)" ] && [ "$(value charts)" -ge "$least" ] || fail "fewer than $least charts"
[ "$(value drawn)" = "$(value charts)" ] || fail "charts not drawn"
grep -q 'data-empty=""' <<<"$mark" || fail "empty charts: $(value empty)"
[ -n "${WIDTH:-}" ] || grep -q 'data-interactions=""' <<<"$mark" || fail "without effect: $(value interactions)"
[ -z "$(value crowded)" ] || fail "labels without room: $(value crowded)"
[ "$(value wide)" = 0 ] || fail "the section is wider than the screen"
bytes=$(stat -c %s "$page")
[ "$bytes" -le "$largest" ] || fail "$bytes bytes, more than $largest"
if grep CONSOLE "$work/log"; then fail "the console is not silent"; fi
exit $status
