#!/usr/bin/env bash
# Takes the files of docs/recipes.md out of the page. A block "```cpp PATH" is a file; the `+` lines of a block "```diff PATH" go
# into a copy of SOURCE/PATH, each behind the line of the block above it. All are put into OUT; their names are printed.
#   extract.sh PAGE SOURCE OUT
set -euo pipefail
page=$1 source=$2 out=$3
fresh=$(mktemp -d); trap 'rm -rf "$fresh"' EXIT
mkdir -p "$out"
awk -v out="$fresh" -v source="$source" '
    function fail(what) { print FILENAME ":" FNR ": " what > "/dev/stderr"; failed = 1; exit 1 }
    function name(path) { sub(/.*\//, "", path); return out "/" path }
    !kind && /^```(cpp|diff) / { kind = substr($1, 4); path = $2; at = n = 0
                                 if (kind == "diff") while ((getline line < (source "/" path)) > 0) text[++n] = line
                                 if (kind == "diff" && !n) fail(path " is not there")
                                 next }
    kind == "cpp" && /^```/ { close(name(path)); kind = ""; next }
    kind == "diff" && /^```/ { for (i = 1; i <= n; ++i) print text[i] > name(path)
                               close(name(path)); kind = ""; next }
    kind == "cpp" { print > name(path) }
    kind == "diff" && /^ / { wanted = substr($0, 2)
                             for (++at; at <= n && text[at] != wanted; ++at) {}
                             if (at > n) fail(path " has no line \"" wanted "\" there") }
    kind == "diff" && /^\+/ { for (i = ++n; i > at + 1; --i) text[i] = text[i - 1]
                              text[++at] = substr($0, 2) }
    END { if (!failed && kind) fail("a block does not end"); if (failed) exit 1 }' "$page"
for file in "$fresh"/*; do
    cmp -s "$file" "$out/${file##*/}" || cp "$file" "$out"   # keeps the time of what has not changed
    echo "${file##*/}"
done
