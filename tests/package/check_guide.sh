#!/usr/bin/env bash
# A page with a session: runs every command of it, in order, and looks for every line of output that it shows. Other blocks than those of output
# name their language after the ```; one of TOML that begins "# at the end of FILE" is written there. Without a Chromium --pdf is left out. How far a --budget of seconds gets is the machine's affair: there 4, not
# within the tolerance, is an answer too.
#   check_guide.sh DAMSLIP SOURCE PAGE FILE ...     FILE: that the commands leave in their folder
set -euo pipefail
program=$1 source=$2 page=$3
shift 3
printing=no
for browser in chromium chromium-browser google-chrome google-chrome-stable; do command -v "$browser" >/dev/null && printing=yes; done
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
        [ "$printing" = yes ] || line=$(sed 's/ --pdf [^ ]*//' <<<"$line")
        code=0; eval "$line" >answer 2>talk || code=$?
        case $code$line in 0*|4*' --budget '*) ;; *) fail "$line exits with $code: $(tail -n 3 talk)" ;; esac
        squeezed answer >squeezed
        commands=$((commands + 1)) ;;
    'no    sed '*) eval "$line" ;;
    'other# at the end of '*) file=${line#'# at the end of '} ;;
    'no```') shown=yes ;;
    'no```'*) shown=other file=/dev/null ;;
    'other```') shown=no ;;
    other*) printf '%s\n' "$line" >>"$file" ;;
    'yes```') shown=no ;;
    yes*)
        printf '%s\n' "$line" >wanted
        grep -qF -- "$(squeezed wanted)" squeezed || fail "command $commands no longer says: $line" ;;
    esac
done <"$source/docs/$page"
[ "$commands" -ge 6 ] || fail "only $commands commands were found"
for file in "$@"; do
    case $file in *.pdf) [ "$printing" = yes ] || continue ;; esac
    [ -s "$file" ] || fail "$file was not written"
done
