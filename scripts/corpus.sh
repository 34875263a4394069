#!/usr/bin/env bash
# The corpora of the fuzzers: one archive for each target, tests/fuzz/corpus/<name>.tar.xz.
#   scripts/corpus.sh unpack NAME FOLDER   puts its files into FOLDER
#   scripts/corpus.sh pack NAME FOLDER     makes the archive of the files of FOLDER: the same bytes from the same files
#   scripts/corpus.sh minimise NAME [FOLDER ...]   keeps what adds coverage, of the archive and of the folders (found by
#                                          a fuzzer); needs build/fuzz/tests/fuzz/fuzz_NAME (cmake --preset fuzz)
set -euo pipefail
cd "$(dirname "$0")/.."
usage() { sed -n '3,6p' "$0" | sed 's/^# *//' >&2; exit 2; }
[ $# -ge 2 ] || usage
action=$1 name=$2
archive=tests/fuzz/corpus/$name.tar.xz
shift 2

unpack() { mkdir -p "$1"; tar -C "$1" -xJf "$archive"; }
pack() {
    (cd "$1" && find . -maxdepth 1 -type f -printf '%P\n' | LC_ALL=C sort) |
        tar -C "$1" -cf - --no-recursion --mtime=@0 --owner=0 --group=0 --numeric-owner --mode=0644 -T - | xz -9e >"$archive.part"
    mv "$archive.part" "$archive"
}

case "$action" in
    unpack) [ $# -eq 1 ] || usage; unpack "$1" ;;
    pack) [ $# -eq 1 ] || usage; pack "$1" ;;
    minimise)
        work=$(mktemp -d)
        trap 'rm -rf "$work"' EXIT
        mkdir "$work/kept"
        if [ -e "$archive" ]; then unpack "$work/old"; else mkdir "$work/old"; fi
        build/fuzz/tests/fuzz/fuzz_"$name" -merge=1 -timeout=60 -rss_limit_mb=4096 "$work/kept" "$work/old" "$@"
        pack "$work/kept"
        ;;
    *) usage ;;
esac
