#!/usr/bin/env bash
# scripts/skipped.sh on made logs; and scripts/test.sh installs what the Python tests need and asks it.
#   check_skipped.sh SOURCE
set -euo pipefail
log=$(mktemp); trap 'rm -f "$log"' EXIT
fail() { echo "FAIL: $*" >&2; exit 1; }
line() { printf ' 1/2 Test #7: %s ......   %s   0.02 sec\n' "$1" "$2"; }
line Screen.Slides Passed >"$log"
line SlammerSet.slips '***Skipped' >>"$log"
"$1/scripts/skipped.sh" "$log" || fail "what may be skipped fails"
for how in '***Skipped' '***Not Run'; do
    { line python.results "$how"; echo '100% tests passed, 0 tests failed out of 2'; } >"$log"
    if said=$("$1/scripts/skipped.sh" "$log" 2>&1); then fail "$how passes"; fi
    [[ $said == *python.results*"tests passed"* ]] || fail "it says: $said"
done
grep -q '^scripts/setup.sh tests python reports$' "$1/scripts/test.sh" || fail "scripts/test.sh does not install Python"
grep -q '^scripts/skipped.sh build/release/ctest.log$' "$1/scripts/test.sh" || fail "scripts/test.sh does not ask for skipped tests"
