#!/usr/bin/env bash
# Installs what is missing, builds, and runs all tests; one that is skipped fails here. --all: then the long tests too, a fragility killed twenty
# times, the notebook of the Python package, a build of every file by itself, a comparison with another finite-element program, the suite under the address and undefined-behaviour checkers, and what
# share of the lines the tests reach (an hour or more on two cores).
set -euo pipefail
cd "$(dirname "$0")/.."
case "${1:-}" in '' | --all) ;; *) echo "usage: scripts/test.sh [--all]" >&2; exit 2 ;; esac
scripts/setup.sh tests python reports
cmake --preset release -DDAMSLIP_PYTHON=ON >/dev/null
cmake --build --preset release
ctest --preset release --parallel "$(nproc)" | tee build/release/ctest.log

scripts/skipped.sh build/release/ctest.log
[ "${1:-}" = --all ] || exit 0

scripts/setup.sh office
build/release/damslip-verify verify --digest -q   # the verification record of the release

ctest --test-dir build/release --label-regex '^long$' --output-on-failure --no-tests=error --parallel "$(nproc)"
tests/surroundings/check_fragility.sh build/release/damslip . 20
scripts/python.sh --notebook
cmake --preset dev >/dev/null   # every file by itself, warnings are errors
cmake --build --preset dev
scripts/second-solver.sh         # damslip beside CalculiX, where that can be had
scripts/sanitize.sh
scripts/coverage.sh
