#!/usr/bin/env bash
# Compares damslip with CalculiX, another finite-element program, on the scenes of tests/second_solver: natural modes, tied
# earthquakes, a base that slips, and one that opens, under static loads. Installs calculix-ccx where it is missing and can be had (--no-install: never), else
# skips with a word. Needs a built program: scripts/test.sh.
set -euo pipefail
cd "$(dirname "$0")/.."
case "${1:-}" in '' | --no-install) ;; *) echo "usage: scripts/second-solver.sh [--no-install]" >&2; exit 2 ;; esac
program=build/release/damslip
[ -x "$program" ] || { echo "second-solver: $program is not built; run scripts/test.sh first" >&2; exit 3; }
if ! command -v ccx >/dev/null && [ "${1:-}" != --no-install ]; then
  sudo=$([ "$(id -u)" = 0 ] || echo sudo)
  $sudo apt-get install -y --no-install-recommends calculix-ccx >/dev/null 2>&1 || true
fi
command -v ccx >/dev/null || { echo "second-solver: skipped, CalculiX (package calculix-ccx) is not installed"; exit 0; }

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failed=0
seconds() { awk -v a="$1" -v b="$2" 'BEGIN { printf "%.2f", b - a }'; }
compare() {   # scene, analysis, modes
  local deck="$folder/$1-$2" start middle end
  local arguments=("tests/second_solver/$1.toml" --to calculix --analysis "$2" --modes "$3" --quiet)
  "$program" mesh "${arguments[@]}" --out "$deck.inp"
  start=$(date +%s.%N)
  (cd "$folder" && ccx -i "$1-$2" >"$deck.log" 2>&1) || true   # what is missing in its results is said below
  middle=$(date +%s.%N)
  "$program" mesh "${arguments[@]}" --results "$deck.dat" || failed=1
  end=$(date +%s.%N)
  echo "  $2: CalculiX $(seconds "$start" "$middle") s, damslip $(seconds "$middle" "$end") s of wall time"
  echo
}
export OMP_NUM_THREADS=1
compare koyna modes 8
compare koyna tied 60
compare water modes 8
compare water tied 60
compare contact static-contact 1
compare opening static-contact 1
times >"$folder/times"
awk 'END { split($1, user, /[ms]/); split($2, kernel, /[ms]/)
           printf "processor seconds of both programs: %.0f\n", 60 * (user[1] + kernel[1]) + user[2] + kernel[2] }' "$folder/times"
[ "$failed" = 0 ] && echo "second-solver: all within what is allowed" || { echo "second-solver: outside of what is allowed, see above" >&2; exit 1; }
