#!/usr/bin/env bash
# The user guide: runs every command of it, in order, and looks for every line of output that it shows.
#   check_guide.sh DAMSLIP SOURCE
set -euo pipefail
program=$1 source=$2
work=$(mktemp -d); trap 'rm -rf "$work"' EXIT
fail() { echo "FAIL: $*" >&2; exit 1; }
ln -s "$source/examples" "$source/records" "$work"
cd "$work"
damslip() { "$program" "$@"; }
squeezed() { tr -s ' ' <"$1" | sed 's/^ //; s/ $//'; }
: >answer
shown=no commands=0
while IFS= read -r line; do
    case $shown$line in
    'no    damslip '*)
        eval "$line" >answer 2>talk || fail "$line exits with $?: $(tail -n 3 talk)"
        squeezed answer >squeezed
        commands=$((commands + 1)) ;;
    'no```') shown=yes ;;
    'yes```') shown=no ;;
    yes*)
        printf '%s\n' "$line" >wanted
        grep -qF -- "$(squeezed wanted)" squeezed || fail "command $commands no longer says: $line" ;;
    esac
done <"$source/docs/user-guide.md"
[ "$commands" -ge 6 ] || fail "only $commands commands were found"
for file in fe/report.html fe/summary.json sweep.csv sweep.html accuracy/report.html; do
    [ -s "results/$file" ] || fail "results/$file was not written"
done
