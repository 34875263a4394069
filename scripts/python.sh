#!/usr/bin/env bash
# Installs what the Python package needs, builds it into build/release/python, and runs its tests.
#   scripts/python.sh              the module and tests/python
#   scripts/python.sh --notebook   the same, then runs the notebook of examples/notebook with nbconvert
set -euo pipefail
cd "$(dirname "$0")/.."
case "${1:-}" in '' | --notebook) ;; *) sed -n '3,4p' "$0" | sed 's/^# *//' >&2; exit 2 ;; esac
scripts/setup.sh tests python ${1:+notebook}
cmake --preset release >/dev/null   # finds Python and pybind11, now that they are there
cmake --build --preset release --target damslip damslip_python
ctest --test-dir build/release --label-regex '^python$' --output-on-failure --no-tests=error
[ "${1:-}" = --notebook ] || exit 0

out=build/release/notebook
mkdir -p "$out"
PYTHONPATH="$PWD/build/release/python" jupyter nbconvert --to html --execute examples/notebook/own_dam.ipynb --output-dir "$out"
echo "notebook: $out/own_dam.html"
