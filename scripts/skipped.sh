#!/usr/bin/env bash
# Fails where a test of a ctest log was skipped, and names it: a test that is skipped has proved nothing. Two may be: they need files of others
# that cannot be handed on.
#   skipped.sh LOG
set -euo pipefail
skipped=$(sed -n 's/^.*Test *#[0-9]*: \([^ ]*\) .*\*\*\*Skipped.*/\1/p; s/^.*Test *#[0-9]*: \([^ ]*\) .*\*\*\*Not Run.*/\1/p' "$1" |
          grep -v '^RecordFormatsFolder\.\|^SlammerSet\.' || true)
[ -z "$skipped" ] && exit 0
echo "skipped, which is a failure here:" $skipped >&2
sed -n '/tests passed, /,$p' "$1" # the closing lines once more
exit 1
