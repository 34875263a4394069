#!/bin/sh
# 20 artificial pairs of records, 20 s at 0.01 s, that match three spectra of Eurocode 8 and of hard rock; the same bytes wherever it runs.
# Made once, before suite.toml is used (a minute); only the seeds below are shipped.
#   examples/fragility/make_suite.sh build/release/damslip [DIR]      # DIR: suite beside this script
# Pair i: seed i, spectrum by i modulo 3, PGA 2 m/s2 horizontal; the vertical component has a random stream of its own
# and keeps within 20 % of its spectrum, where 10 % is not reached by all seeds.
set -eu
program=$1
folder=${2:-$(dirname "$0")/suite}
mkdir -p "$folder"
i=1
while [ "$i" -le 20 ]; do
    case $((i % 3)) in
        0) target="--target rock" ;;
        1) target="--target ec8-1 --ground A" ;;
        2) target="--target ec8-2 --ground B" ;;
    esac
    name=$(printf 'pair_%02d' "$i")
    # shellcheck disable=SC2086  # two words
    "$program" record generate --quiet $target --pga-m-s2 2 --seed "$i" --component h --out "$folder/${name}_h.csv"
    # shellcheck disable=SC2086
    "$program" record generate --quiet $target --pga-m-s2 2 --seed "$i" --component v --tolerance 0.2 --out "$folder/${name}_v.csv"
    i=$((i + 1))
done
{
    echo horizontal,vertical,event
    i=1
    while [ "$i" -le 20 ]; do
        name=$(printf 'pair_%02d' "$i")
        echo "${name}_h.csv,${name}_v.csv,$name"
        i=$((i + 1))
    done
} > "$folder/suite.csv"
head -6 "$folder/suite.csv" > "$folder/five.csv" # for coarse.toml
