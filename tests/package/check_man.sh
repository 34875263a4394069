#!/usr/bin/env bash
# The manual pages: one per command, and as many of `man --warnings` and `mandoc -Tlint` as there are find nothing to warn about.
#   check_man.sh DAMSLIP
set -euo pipefail
work=$(mktemp -d); trap 'rm -rf "$work"' EXIT
fail() { echo "FAIL: $*" >&2; exit 1; }
"$1" man --out "$work"
for command in screen sweep fe modes explain accuracy verify record record-info schema completion; do
    page=$work/damslip-$command.1
    [ -s "$page" ] || fail "no page of $command"
    grep -q '^\.SH SYNOPSIS' "$page" || fail "$page has no synopsis"
done
# Every flag of a help text is on its page.
for flag in $("$1" fe --help | grep -o -- '--[a-z-]*' | sort -u); do
    grep -qF -- "${flag//-/\\-}" "$work/damslip-fe.1" || fail "fe: $flag is not on its page"
done
if command -v man >/dev/null; then
    for page in "$work"/*.1; do
        said=$(MANWIDTH=80 man --warnings -l "$page" 2>&1 >/dev/null)
        [ -z "$said" ] || fail "man $page: $said"
    done
fi
if command -v mandoc >/dev/null; then
    mandoc -T lint -W warning "$work"/*.1 || fail "mandoc"
fi
