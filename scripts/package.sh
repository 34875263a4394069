#!/usr/bin/env bash
# Installs what is missing, builds, and packs: damslip_<version>_<architecture>.deb in build/release.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh package
cmake --preset release -DDAMSLIP_TESTS=OFF >/dev/null
cmake --build --preset release --target damslip damslip_pages
(cd build/release && cpack --config CPackConfig.cmake >cpack.log || { cat cpack.log >&2; exit 1; })
ls build/release/damslip_*.deb
