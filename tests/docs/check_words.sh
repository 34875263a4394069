#!/usr/bin/env bash
# The words that docs/symbols.md rules out (second column of its table "Words") do not stand in README.md, docs/*.md, nor in sentences of
# the program, but where they are code (in backticks, or a block).
#   check_words.sh SOURCE
set -euo pipefail
cd "$1"
failed=0
words=$(sed -n '/^## Words/,$p' docs/symbols.md | awk -F'|' 'NF > 4 { print $3 }' | grep -o '`[^`]*`' | tr -d '`')
[ "$(wc -l <<<"$words")" -ge 15 ] || { echo "docs/symbols.md: only $(wc -l <<<"$words") words are ruled out"; exit 1; }
# Prose alone: no blocks, no code, no addresses of links.
prose() { awk '/^```/ { code = !code; print ""; next } { print (code || /^    /) ? "" : $0 }' "$1" | sed 's/`[^`]*`//g; s/](\([^)]*\))/]/g'; }
# The strings of a source that are sentences: with a blank in them.
strings() { sed 's|//.*||; s/--[a-z]*//g' "$1" | awk '{ out = ""; while (match($0, /"([^"\\]|\\.)*"/)) { word = substr($0, RSTART, RLENGTH); if (word ~ / /) out = out word; $0 = substr($0, RSTART + RLENGTH) } print out }'; }
look() { # PAGE, its text on standard input
    if hits=$(grep -niwFf <(echo "$words") -); then
        echo "$1: docs/symbols.md has another word for one of"
        cut -c1-160 <<<"$hits"
        failed=1
    fi
}
for page in README.md docs/*.md; do
    if [ "$page" = docs/symbols.md ]; then continue; fi
    look "$page" < <(prose "$page")
done
for source in src/pages/*/*.cpp src/cli/*.cpp src/scene/*.cpp src/analysis/*/*.cpp; do look "$source" < <(strings "$source"); done
exit $failed
