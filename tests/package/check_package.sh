#!/usr/bin/env bash
# Installs the build into a fresh folder, builds programs of examples/api against it, and compares their answers with the installed
# program's.
#   check_package.sh CMAKE SOURCE BUILD GENERATOR PROGRAM ...
set -euo pipefail
cmake=$1 source=$2 build=$3 generator=$4
shift 4
asked() { case " $programs " in *" $1 "*) ;; *) return 1 ;; esac; }
programs=$*
work=$(mktemp -d); trap 'rm -rf "$work"' EXIT
fail() { echo "FAIL: $*" >&2; exit 1; }

"$cmake" --install "$build" --prefix "$work/prefix" >"$work/install.log" || { tail -n 5 "$work/install.log"; fail "install"; }
if grep -rlF "$source" "$work/prefix/lib" --include='*.cmake'; then fail "the package points into the source folder"; fi
CXXFLAGS=-O0 "$cmake" -S "$source/examples/api" -B "$work/build" -G "$generator" -DCMAKE_PREFIX_PATH="$work/prefix" >"$work/configure.log" 2>&1 \
    || { tail -n 20 "$work/configure.log"; fail "configure"; }
"$cmake" --build "$work/build" --target "$@" >"$work/build.log" 2>&1 || { tail -n 20 "$work/build.log"; fail "build"; }

# The scene is that of the installed examples, with the records where it looks for them; every program gives the digits of
# the installed one.
damslip=$work/prefix/bin/damslip
examples=$work/prefix/share/damslip/examples
scene=$examples/short.toml
{ sed 's/^\[reservoir\]/&\nmodel = "added-mass"/' "$examples/reference_dam_profile.toml"; printf '\n[time]\nsubsteps = 2\n[mesh]\nsize_m = 9\ncontact_size_m = 5\nrock_size_m = 20\n'; } >"$scene" # few elements
cd "$work"
same() { [ "$1" = "$2" ] || fail "$3: \"$1\", but damslip says \"$2\""; }
# printed KEY: all its values in indented JSON, as the programs print them
printed() { awk -v key="\"$1\":" '$1 == key {printf "%.4f\n", $2}'; }
printed_mm() { awk -v key="\"$1\":" '$1 == key {printf "%.4f\n", 1000 * $2}'; }

if asked screen; then
    build/screen "$scene" | tee screen.txt
    grep -q '^yield acceleration  0.614604 m/s2$' screen.txt || fail "the yield acceleration by hand is 0.614604 m/s2" # docs/loads-and-equilibrium.md
    same "$(sed -n 's/.*slip \([0-9.]*\) mm.*/\1/p' screen.txt)" \
         "$("$damslip" screen "$scene" --json --quiet | sed -n '/"displacements"/,/"statistics"/p' | printed slip_hv_mm)" "screen"
fi
if asked fe; then
    build/fe "$scene" | tee fe.txt
    same "$(sed -n 's/.*slip \([0-9.]*\) mm.*/\1/p' fe.txt)" \
         "$("$damslip" fe "$scene" --json --quiet | sed -n '/"runs"/,/"slip"/p' | printed slip_mm)" "fe"
fi
if asked sweep; then
    build/sweep "$scene" 2>progress.txt | tee sweep.txt
    grep -q '100 %' progress.txt || fail "sweep tells no progress"
    same "$(sed -n 's/.*slip \([0-9.]*\) mm.*/\1/p' sweep.txt)" \
         "$("$damslip" sweep "$scene" --friction 0.7,0.8,0.9 --method rigid,fe --json --quiet | printed_mm slip_m)" "sweep"
fi
if asked accuracy; then
    build/accuracy "$scene" | tee accuracy.txt
    grep -q '^fe-' accuracy.txt || fail "accuracy ran no finite elements"
fi
