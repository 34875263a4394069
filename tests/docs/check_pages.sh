#!/usr/bin/env bash
# README.md and docs/*.md: every link leads somewhere, every page is in the index docs/README.md and every figure on a page; the files,
# verification cases, commands and flags they name are there.
#   check_pages.sh DAMSLIP SOURCE
set -euo pipefail
program=$1
cd "$2"
work=$(mktemp -d); trap 'rm -rf "$work"' EXIT
failed=0
wrong() { echo "$*" >&2; failed=1; }
pages=(README.md docs/*.md)

# GitHub's anchors: lower case, blanks to hyphens, other signs than letters, digits, hyphens and underscores gone.
anchors() { sed -n 's/^##* //p' "$1" | sed 's/`//g; s/\[\([^]]*\)\]([^)]*)/\1/g' | tr 'A-Z ' 'a-z-' | tr -d '.,:;()/!?"=+*'"'"; }
without_code() { awk '/^```/ { code = !code; next } !code && !/^    /' "$1"; }

: >"$work/linked"
for page in "${pages[@]}"; do
    folder=$(dirname "$page")
    without_code "$page" | grep -o '](\([^)]*\))' | sed 's/^](//; s/)$//' | sort -u >"$work/links" || true
    while IFS= read -r link; do
        case $link in http://* | https://*) continue ;; esac
        file=${link%%#*} target=$page
        [ -z "$file" ] || target=$folder/$file
        [ -e "$target" ] || { wrong "$page: $link leads nowhere"; continue; }
        [ "$target" = "$page" ] || realpath --relative-to=. "$target" >>"$work/linked"
        case $link in *#*) anchors "$target" | grep -qxF -- "${link#*#}" || wrong "$page: $link has no such heading" ;; esac
    done <"$work/links"

    # Files of the source tree in backticks: a path with a folder of it in front.
    { grep -o '`[^`]*`' "$page" || true; } | tr -d '`' | grep -xE '(src|sliding|fe2d|records|verification|studies|tests|examples|scripts|docs|cmake)/[A-Za-z0-9_./-]+' |
        sort -u >"$work/files" || true
    while IFS= read -r file; do
        [ -e "$file" ] || compgen -G "$file.*" >/dev/null || wrong "$page: $file is not there"
    done <"$work/files"
done

for file in docs/*.md docs/figures/* docs/*.svg; do
    [ "$file" = docs/README.md ] || grep -qxF "$file" "$work/linked" || wrong "$file: no page links to it"
done
for file in docs/*.md; do
    [ "$file" = docs/README.md ] || grep -qF "](${file#docs/}" docs/README.md || wrong "docs/README.md does not list ${file#docs/}"
done

# "Where is ..." of the layout: the functions of a row are in one of its files.
grep -E '^\| .*\.[ch]pp`' docs/layout.md >"$work/rows"
while IFS= read -r row; do
    grep -o '`[A-Za-z0-9_/]*\.[ch]pp`' <<<"$row" | tr -d '`' >"$work/files" || true
    while IFS= read -r name; do
        while IFS= read -r file; do grep -qE "(^|[^A-Za-z_])${name##*::}\(" "$file" 2>/dev/null && continue 2; done <"$work/files"
        wrong "docs/layout.md: $name() is not in $(paste -sd' ' "$work/files")"
    done < <(grep -o '`[A-Za-z_:]*()`' <<<"$row" | tr -d '`()')
done <"$work/rows"

# Commands: lines of code that call the program, and calls in backticks.
{ grep -hE '^    (build/release/)?damslip ' "${pages[@]}"; cat "${pages[@]}" | grep -o '`damslip [^`]*`' | tr -d '`'; } |
    sed 's/^ *//; s|^build/release/||; s/  *#.*//; s/ > .*//; s/[|\\].*//' | sort -u >"$work/commands"
{ "$program" verify --list; "$program" verify --hard --list; } >"$work/cases"
while read -r _ command rest; do
    case $command in -* | [A-Z]* | '') continue ;; esac
    read -ra words <<<"$rest"
    path=$command
    [ "$command" != record ] || case ${words[0]:-} in info | convert | baseline | scale | spectrum | generate) path="record ${words[0]}" ;; *) continue ;; esac
    help=$work/help.${path// /.}
    # shellcheck disable=SC2086
    [ -s "$help" ] || "$program" $path --help >"$help" 2>/dev/null || { wrong "damslip $command $rest: there is no such command"; continue; }
    for word in "${words[@]}"; do
        case $word in
        --*) flag=${word%%=*}; grep -qE -- "(^|[ ,])$flag([ ,]|$)" "$help" || wrong "damslip $command $rest: $path has no $flag" ;;
        esac
    done
    if [ "$command" = verify ] && [[ ${words[0]:-} =~ ^[a-z] ]]; then
        grep -qF -- "${words[0]}" "$work/cases" || wrong "damslip verify ${words[0]}: there is no such case"
    fi
done <"$work/commands"
[ "$(wc -l <"$work/commands")" -ge 30 ] || wrong "only $(wc -l <"$work/commands") commands were found"
exit $failed
