#!/usr/bin/env bash
# Runs the suite in a build that counts lines and branches, and prints what share of each folder the tests reach; every file in
# build/coverage/coverage.csv, every line in build/coverage/coverage.html.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh tests coverage
cmake --preset coverage >/dev/null
targets=(damslip_unit_tests damslip_property_tests damslip_input_tests random_scenes replay_corpora)
cmake --build --preset coverage --target "${targets[@]}"
find build/coverage -name '*.gcda' -delete   # of runs before
ctest --preset coverage --parallel "$(nproc)" --label-regex '^(unit|property|input|random)$' --timeout 3600
gcovr --root . --object-directory build/coverage --filter 'src/' --filter 'records/' --filter 'sliding/' --filter 'fe2d/' \
      --exclude 'build/' --exclude-throw-branches --exclude-unreachable-branches -j "$(nproc)" \
      --csv build/coverage/coverage.csv --html-details build/coverage/coverage.html
awk -F, '
    NR > 1 {
        split($1, part, "/"); folder = part[1] "/" part[2]
        lines[folder] += $2; hit[folder] += $3; branches[folder] += $5; taken[folder] += $6
        lines["all"] += $2; hit["all"] += $3; branches["all"] += $5; taken["all"] += $6
    }
    END {
        printf "%-22s %7s %8s %9s %9s\n", "folder", "lines", "reached", "branches", "taken"
        for (f in lines)
            printf "%-22s %7d %7.1f%% %9d %8.1f%%\n", f, lines[f], 100 * hit[f] / lines[f], branches[f],
                   branches[f] ? 100 * taken[f] / branches[f] : 100 | "sort"
    }' build/coverage/coverage.csv
