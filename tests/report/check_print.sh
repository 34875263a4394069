#!/usr/bin/env bash
# check_print.sh DAMSLIP SCENE: `screen --pdf` writes an A4 file of several pages, and says before it computes what is in the way of
# one: no browser on the PATH, a folder that is no file.
set -euo pipefail
damslip=$1 scene=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "FAIL: $1"; exit 1; }

"$damslip" screen "$scene" --pdf "$work/report.pdf" >"$work/stdout" 2>"$work/talk" || { cat "$work/talk"; exit 1; }
[ "$(tail -n 1 "$work/talk")" = "report: $work/report.pdf" ] || fail "the last line of the talk does not name the report"
[ "$(head -c 5 "$work/report.pdf")" = "%PDF-" ] || fail "no PDF"
pages=$(grep -ac '/MediaBox \[0 0 594\.9[0-9]* 841\.9[0-9]*\]' "$work/report.pdf" || true)
[ "$pages" -ge 4 ] || fail "$pages A4 pages"
[ "$(grep -ac '/MediaBox' "$work/report.pdf")" = "$pages" ] || fail "a page that is not A4"

mkdir "$work/empty"
status=0
PATH="$work/empty" "$damslip" screen "$scene" --pdf "$work/none.pdf" >"$work/stdout" 2>"$work/talk" || status=$?
[ "$status" = 2 ] || fail "exit code $status without a browser, not 2"
[ ! -s "$work/stdout" ] || fail "something was computed before the browser was missed"
grep -q 'there is no Chromium to print with' "$work/talk" || fail "the missing browser is not named"
grep -q 'fix: .*apt install chromium' "$work/talk" || fail "no fix"
status=0
"$damslip" screen "$scene" --pdf "$work/empty" >"$work/stdout" 2>"$work/talk" || status=$?
[ "$status" = 2 ] && [ ! -s "$work/stdout" ] || fail "a folder is taken for a file: exit code $status"
