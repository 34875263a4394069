#!/usr/bin/env bash
# Installs what is missing, builds, and answers: how far does the reference dam slide under the shipped records?
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh
cmake --preset release -DDAMSLIP_TESTS=OFF >/dev/null
cmake --build --preset release --target damslip
build/release/damslip screen examples/reference_dam.toml --out results/demo
