#!/usr/bin/env bash
# Builds the reference of all speed figures, commit bca3a65, aside in build/reference (the program and its bench of the rigid
# block, once), then runs it and build/release/damslip in turn on the same scenes and prints medians and ratios
# (docs/performance.md). The case "batch" runs both benches; this program's is built here, in build/bench.
#
#   scripts/bench_reference.sh [--runs 5] [--build-only] [CASE ...]     # cases: scripts/bench_reference.py --list
set -euo pipefail
cd "$(dirname "$0")/.."
reference=bca3a65
where=build/reference
options=()
build_only=false
while [ $# -gt 0 ]; do
    case "$1" in
        --build-only) build_only=true; shift ;;
        *) options+=("$1"); shift ;;
    esac
done
jobs=${DAMSLIP_BENCH_JOBS:-$(nproc)}
bench=tests/bench/sliding_bench
if [ ! -e "$where/source" ]; then
    git worktree prune
    git worktree add --quiet --detach "$where/source" "$reference"
fi
if [ ! -x "$where/build/damslip" ]; then
    cmake -S "$where/source" -B "$where/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DDAMSLIP_TESTS=OFF -DCMAKE_UNITY_BUILD=ON >/dev/null
    cmake --build "$where/build" --target damslip --parallel "$jobs"
fi
if [ ! -x "$where/bench/$bench" ]; then
    cmake -S "$where/source" -B "$where/bench" -G Ninja -DCMAKE_BUILD_TYPE=Release -DDAMSLIP_TESTS=OFF -DDAMSLIP_BENCH=ON -DCMAKE_UNITY_BUILD=ON >/dev/null
    cmake --build "$where/bench" --target sliding_bench --parallel "$jobs"
fi
$build_only && exit 0
[ -x build/release/damslip ] || { echo "build/release/damslip is missing: cmake --preset release && cmake --build --preset release" >&2; exit 3; }
cmake --preset bench >/dev/null
cmake --build --preset bench --target sliding_bench --parallel "$jobs"
exec python3 scripts/bench_reference.py --reference "$where/build/damslip" --program build/release/damslip \
    --reference-bench "$where/bench/$bench" --program-bench "build/bench/$bench" "${options[@]}"
