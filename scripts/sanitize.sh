#!/usr/bin/env bash
# The suite under the address and undefined-behaviour checkers, with assertions: the tests of units, properties, input files
# and random scenes, and the replayed fuzz corpora. (Slower than the optimised build by ten and more; the sabotaged programs and
# the reports in a browser would add nothing.)
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh tests
cmake --preset sanitize >/dev/null
cmake --build --preset sanitize --target damslip_unit_tests damslip_property_tests damslip_input_tests random_scenes replay_corpora
export UBSAN_OPTIONS=print_stacktrace=1
ctest --preset sanitize --parallel "$(nproc)" --label-regex '^(unit|property|input|random)$' --timeout 3600
