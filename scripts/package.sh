#!/usr/bin/env bash
# Installs what is missing, builds, and packs: damslip_<version>_<architecture>.deb in build/release, and where
# Python's development files are there (scripts/python.sh) python3-damslip_<version>_<architecture>.deb.
#   scripts/package.sh                   packs
#   scripts/package.sh --check           packs; builds examples/api on the installed libraries; then as below
#   scripts/package.sh --check FILE.deb  installs the package with apt, tries it out, removes it
# Checks need apt, and root or sudo; they install man-db to read the pages with.
set -euo pipefail
cd "$(dirname "$0")/.."
usage() { sed -n '4,7p' "$0" | sed 's/^# *//' >&2; exit 2; }
case "${1:-}" in '') [ $# -eq 0 ] || usage ;; --check) [ $# -le 2 ] || usage ;; *) usage ;; esac
fail() { echo "package: $*" >&2; exit 1; }
as_root() { if [ "$(id -u)" -eq 0 ]; then "$@"; else sudo "$@"; fi; }

pack() {
    scripts/setup.sh package
    cmake --preset release -DDAMSLIP_TESTS=OFF >/dev/null
    cmake --build --preset release
    rm -f build/release/{,python3-}damslip_*.deb
    (cd build/release && cpack --config CPackConfig.cmake >cpack.log || { cat cpack.log >&2; exit 1; })
    ls build/release/*damslip_*.deb
}

# The package on this machine, from a folder that knows nothing of the source.
try_out() {
    local deb work
    deb=$(realpath "$1")
    if dpkg-query -W -f='${Status}' damslip 2>/dev/null | grep -q 'ok installed'; then fail "damslip is installed already; remove it first"; fi
    export DEBIAN_FRONTEND=noninteractive
    as_root apt-get update -qq
    as_root apt-get install -y -qq --no-install-recommends "$deb" man-db >/dev/null
    work=$(mktemp -d)
    (
        cd "$work"
        damslip screen /usr/share/damslip/examples/reference_dam_profile.toml --out results --quiet >answer
        grep -q '0\.614604' answer || fail "screen: the yield acceleration by hand is 0.614604 m/s2"   # docs/loads-and-equilibrium.md
        [ -s results/report.html ] || fail "screen wrote no report"
        damslip fe /usr/share/damslip/examples/reference_dam_profile.toml --reduced --quiet >answer || fail "fe: $(cat answer)"
        MANWIDTH=80 man damslip | grep -q SYNOPSIS || fail "man damslip"
        MANWIDTH=80 man damslip-fe | grep -q -- --reduced || fail "man damslip-fe"
        damslip completion bash | cmp - /usr/share/bash-completion/completions/damslip || fail "completion of bash"
        damslip completion zsh | cmp - /usr/share/zsh/vendor-completions/_damslip || fail "completion of zsh"
        damslip completion fish | cmp - /usr/share/fish/vendor_completions.d/damslip.fish || fail "completion of fish"
        answer=$(bash -c 'source /usr/share/bash-completion/completions/damslip
                          COMP_WORDS=(damslip scr); COMP_CWORD=1; _damslip; echo "${COMPREPLY[*]}"')
        [ "$answer" = screen ] || fail "completion: scr gives '$answer'"
        [ -s /usr/share/doc/damslip/theory.md ] || fail "the documents are not there"
    )
    rm -rf "$work"
    as_root apt-get purge -y -qq damslip >/dev/null
    ! command -v damslip >/dev/null || fail "damslip is still there after its removal"
    echo "package: ${deb##*/} installs, screens, runs finite elements, has its manual and completion, and goes"
}

if [ $# -eq 2 ]; then
    try_out "$2"
    exit
fi
pack
if [ "${1:-}" = --check ]; then
    tests/package/check_package.sh cmake "$PWD" "$PWD/build/release" Ninja
    try_out build/release/damslip_*.deb
fi
