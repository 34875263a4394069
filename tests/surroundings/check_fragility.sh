#!/usr/bin/env bash
# A fragility has the same bytes however its runs are spread: one thread or two, three shards put together, killed at any moment and resumed.
# So has one by finite elements whose friction is conditioned on: its pilot is run again by every part and every start, and has to be the
# same (with more than 3 kills: scripts/test.sh --all).
# A variable more changes no draw of the others.
#   check_fragility.sh DAMSLIP SOURCE [KILLS]
set -euo pipefail
damslip=$(realpath "$1") source=$(realpath "$2") kills=${3:-3}
work=$(mktemp -d); trap 'rm -rf "$work"' EXIT
fail() { echo "FAIL: $*" >&2; exit 1; }
sed -e "s|\.\./\.\./records|$source/records|; s/2.0 m\/s2, 90 s/2.0 m\/s2/" "$source/examples/fragility/dam.toml" >"$work/dam.toml"
cp "$source/examples/fragility/hazard.csv" "$work/"

run() { # FOLDER FLAGS...
    local out=$work/$1; shift
    "$damslip" fragility "$work/${scene:-dam}.toml" "${sizes[@]}" --out "$out" -q "$@" >"$work/talk" 2>&1
}
same() { # FOLDER: every result of it is that of the run with one thread
    local file
    for file in "${files[@]}"; do cmp "$work/$one/$file" "$work/$1/$file" || fail "$1: $file differs"; done
}
# One thread against two, three parts put together, and kills.
spread() { # NAME KILLS
    local one=$1 kills=$2 shard k full killed=0 process
    run "$one" --jobs 1 || fail "$(cat "$work/talk")"
    run two --jobs 2
    same two
    for shard in 0 1 2; do run shards --jobs 1 --shard "$shard/3" || fail "part $shard: $(cat "$work/talk")"; done
    run shards --merge || fail "merge: $(cat "$work/talk")"
    same shards
    # Killed when its database has grown to a share of its full length, so that the moments are spread over the run on a machine of any speed.
    full=$(wc -c <"$work/$one/samples.sqlite")
    for k in $(seq 1 "$kills"); do
        rm -rf "$work/killed"
        "$damslip" fragility "$work/${scene:-dam}.toml" "${sizes[@]}" --out "$work/killed" --jobs 1 -q >"$work/talk" 2>&1 & process=$!
        until [ "$(wc -c 2>/dev/null <"$work/killed/samples.sqlite" || echo 0)" -ge $((full * (k - 1) / (kills + 1))) ]; do
            kill -0 "$process" 2>/dev/null || break
            sleep 0.01
        done
        kill -KILL "$process" 2>/dev/null && killed=$((killed + 1))
        wait "$process" 2>/dev/null || true
        run killed --jobs 1 --resume || fail "resume after kill $k: $(cat "$work/talk")"
        same killed
    done
    [ "$killed" -gt $((kills / 2)) ] || fail "only $killed of $kills runs were killed before their end"
    rm -rf "$work"/{two,shards,killed}
    told="$told, $one: $killed kills"
}
told=""
sizes=(--samples 400 --share-rows 32) files=(samples.csv fragility.csv hazard_shares.csv fragility.xml summary.json report.html)
spread one "$kills"
[ "$(grep -vc '^#' "$work/one/samples.csv")" -gt 4000 ] || fail "fewer than 4,000 runs"

if [ "$kills" -gt 3 ]; then
# Finite elements of 8 m; the times of summary.json and report.html are those of the machine.
sed -e "s|\.\./\.\./\.\./records|$source/records|; s|\.\./\.\./\.\./examples/fragility/||; /^files = /d" "$source/tests/bench/fragility/coarse.toml" >"$work/coarse.toml"
scene=coarse sizes=(--method fe --samples 64 --share-rows 0) files=(samples.csv fragility.csv hazard_shares.csv fragility.xml)
spread conditioned "$kills"
grep -q '"conditioned_on_friction"' "$work/conditioned/summary.json" || fail "friction was not conditioned on"
scene=dam sizes=(--samples 400 --share-rows 32)
fi

# The draws of mu stand in the column after its name; a variable that changes nothing of the dam is added.
{ cat "$work/dam.toml"; printf '\n[[probability.variable]]\nname = "allowed"\nkey = "criteria.allowable_slip_mm"\n'
  printf 'kind = "epistemic"\nuniform = { min = 10, max = 90 }\n'; } >"$work/more.toml"
scene=more run more --jobs 1 || fail "$(cat "$work/talk")"
draws() {
    grep -v '^#' "$work/$1/samples.csv" | awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next } { print $at["intensity_g"], $at["record"], $at["polarity"], $at["mu"], $at["uplift"] }'
}
draws one >"$work/draws.one"; draws more >"$work/draws.more"
[ "$(sort -u "$work/draws.one" | wc -l)" -gt 1000 ] || fail "the draws of samples.csv were not found"
cmp "$work/draws.one" "$work/draws.more" || fail "a variable added changes the draws of the others"
echo "same bytes with 2 threads, 3 shards$told; same draws with a variable added"
