#!/usr/bin/env bash
# Installs the build into a fresh folder, builds examples/api against it, and compares its answers with the installed program's.
#   check_package.sh CMAKE SOURCE BUILD GENERATOR
set -euo pipefail
cmake=$1 source=$2 build=$3 generator=$4
work=$(mktemp -d); trap 'rm -rf "$work"' EXIT
fail() { echo "FAIL: $*" >&2; exit 1; }

"$cmake" --install "$build" --prefix "$work/prefix" >"$work/install.log" || { tail -n 5 "$work/install.log"; fail "install"; }
if grep -rlF "$source" "$work/prefix/lib" --include='*.cmake'; then fail "the package points into the source folder"; fi
CXXFLAGS=-O0 "$cmake" -S "$source/examples/api" -B "$work/build" -G "$generator" -DCMAKE_PREFIX_PATH="$work/prefix" >"$work/configure.log" 2>&1 \
    || { tail -n 20 "$work/configure.log"; fail "configure"; }
"$cmake" --build "$work/build" >"$work/build.log" 2>&1 || { tail -n 20 "$work/build.log"; fail "build"; }

# The scene is that of the installed examples, with the records where it looks for them; the example runs without vertical motion, with
# added mass for the water, at dt/4.
examples=$work/prefix/share/damslip/examples
scene=$examples/horizontal.toml
{ sed 's/^\[reservoir\]/&\nmodel = "added-mass"/' "$examples/reference_dam_profile.toml"; printf '\n[motion]\nvertical = false\n\n[time]\nsubsteps = 2\n'; } >"$scene"
cd "$work"
build/slip "$scene" | tee answer
grep -q '^yield acceleration  0.614604 m/s2$' answer || fail "the yield acceleration by hand is 0.614604 m/s2"   # README
# printed_as KEY: its first value in indented JSON, rounded as the example prints it
printed_as() { awk -v key="\"$1\":" '$1 == key && !found {printf "%.4f\n", $2; found = 1}'; }
said() { sed -n "s/^slip, $1 *\([0-9.]*\) mm.*/\1/p" answer; }
rigid=$("$work/prefix/bin/damslip" screen "$scene" --json --quiet | printed_as slip_h_mm)
elastic=$("$work/prefix/bin/damslip" fe "$scene" --json --quiet | sed -n '/"runs"/,$p' | printed_as slip_mm)
[ "$(said 'rigid block')" = "$rigid" ] || fail "rigid block: $(said 'rigid block') mm, but damslip screen says $rigid"
[ "$(said 'elastic dam')" = "$elastic" ] || fail "elastic dam: $(said 'elastic dam') mm, but damslip fe says $elastic"
