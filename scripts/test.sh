#!/usr/bin/env bash
# Installs what is missing, builds, and runs the tests. --all: those labelled long, too.
set -euo pipefail
cd "$(dirname "$0")/.."
select=(--label-exclude long)
if [ "${1:-}" = --all ]; then select=(); fi
scripts/setup.sh tests
cmake --preset release >/dev/null
cmake --build --preset release
ctest --preset release --parallel "$(nproc)" "${select[@]}"
