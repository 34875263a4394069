#!/usr/bin/env bash
# Signals end every long command in about a second, too little memory is said and never waited for, streams that end have
# their exit code, and commands that are not watched by a terminal say how far they are in plain lines.
#   check_process.sh DAMSLIP SOURCE
set -euo pipefail
damslip=$1 source=$2
work=$(mktemp -d); trap 'rm -rf "$work"' EXIT
fail() { echo "FAIL: $*" >&2; exit 1; }

# The reference dam on a mesh so fine that each command would go on for minutes.
sed -e "s|\.\./records|$source/records|" "$source/examples/reference_dam.toml" >"$work/dam.toml"
printf '\n[mesh]\ncontact_size_m = 0.25\n' >>"$work/dam.toml"

# A shell starts processes in the background with SIGINT ignored, so one that comes before the program has its handler is lost.
handles_signals() {
    local tries
    for tries in $(seq 500); do
        (( 0x$(awk '/^SigCgt/ { print $2 }' "/proc/$1/status" 2>/dev/null || echo 0) & 2 )) && return
        kill -0 "$1" 2>/dev/null || return 0   # it has ended: what follows says so
        sleep 0.01
    done
    fail "no handler of SIGINT within 5 s"
}

# interrupted SIGNAL DELAY ARGUMENTS...: code 4 soon after the signal. A second is what a free machine takes; the limit is what a
# busy one may, and far below the minutes that the command would go on
interrupted() {
    local signal=$1 delay=$2; shift 2
    "$damslip" "$@" >"$work/out" 2>"$work/talk" & local process=$!
    handles_signals "$process"
    sleep "$delay"
    kill "-$signal" "$process" || fail "damslip $1 had ended after $delay s: $(cat "$work/talk")"
    local begin end code=0
    begin=$(date +%s%N)
    wait "$process" || code=$?
    end=$(date +%s%N)
    [ "$code" = 4 ] || fail "damslip $*: exit code $code after $signal at $delay s"
    [ $(((end - begin) / 1000000)) -lt 10000 ] || fail "damslip $*: $(((end - begin) / 1000000)) ms from $signal to the end"
    grep -qi "interrupted\|stopped" "$work/talk" "$work/out" || fail "damslip $*: nothing said of the interruption"
    [ -z "$(find "$work" -name '*.part')" ] || fail "damslip $*: a file is left half written"
}
for delay in 0.1 0.4 1; do interrupted INT "$delay" fe "$work/dam.toml" --out "$work/fe"; done
interrupted TERM 0.4 fe "$work/dam.toml" --reduced
interrupted TERM 0.4 sweep "$work/dam.toml" --method fe --friction 0.7,0.8 --out "$work/rows.csv"
interrupted INT 0.4 accuracy "$work/dam.toml" --quick
interrupted INT 0.4 study "$work/dam.toml" --out "$work/study"
interrupted INT 0.4 explain "$work/dam.toml" --ablate --method fe
interrupted TERM 0.2 modes "$work/dam.toml" --frf

# --json: one object in any case.
"$damslip" modes "$work/dam.toml" --frf --json >"$work/out" 2>/dev/null & process=$!
handles_signals "$process"
sleep 0.2; kill -INT "$process"; wait "$process" || true
grep -q '"code": 4' "$work/out" || fail "no error object after an interruption"

# Too little memory: a sentence, never a hang.
code=0; (ulimit -v 200000; exec timeout 20 "$damslip" --version) >"$work/out" 2>&1 || code=$?
[ "$code" = 0 ] || fail "--version with little memory: exit code $code"
sed 's/0\.25/0.05/' "$work/dam.toml" >"$work/huge.toml"
code=0; (ulimit -v 300000; exec timeout 60 "$damslip" fe "$work/huge.toml") >"$work/out" 2>"$work/talk" || code=$?
[ "$code" = 4 ] || fail "fe with little memory: exit code $code: $(cat "$work/talk")"
grep -q "not enough memory" "$work/talk" || fail "fe with little memory says: $(cat "$work/talk")"

# Standard output that is full, or whose reader has gone.
code=0; "$damslip" schema >/dev/full 2>"$work/talk" || code=$?
[ "$code" = 3 ] || fail "a full standard output has exit code $code"
grep -q "standard output" "$work/talk" || fail "a full standard output is not named: $(cat "$work/talk")"
code=0; { sleep 1; "$damslip" schema 2>"$work/talk" || echo $? >"$work/code"; } | true   # its reader has gone before it writes
[ "$(cat "$work/code")" = 3 ] || fail "a closed pipe has exit code $(cat "$work/code")"

# Plain lines where no terminal is, none with --quiet.
"$damslip" sweep "$source/examples/reference_dam.toml" >/dev/null 2>"$work/talk"
grep -q "^sweep: 100 %, " "$work/talk" || fail "a sweep does not say that it is done: $(cat "$work/talk")"
if grep -q $'\r' "$work/talk"; then fail "carriage returns in a log file"; fi
"$damslip" sweep "$source/examples/reference_dam.toml" --quiet >/dev/null 2>"$work/talk"
[ ! -s "$work/talk" ] || fail "--quiet talks: $(cat "$work/talk")"
echo "signals, memory, streams and progress: in order"
