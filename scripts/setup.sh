#!/usr/bin/env bash
# Installs what the project is built with (Debian 12, Ubuntu); does nothing when everything is there. Run by demo.sh, test.sh and package.sh.
set -euo pipefail
packages=(g++ cmake ninja-build pkg-config libeigen3-dev libgsl-dev libsuitesparse-dev libopenblas-dev libcli11-dev libtomlplusplus-dev
          nlohmann-json3-dev libfmt-dev libspectra-dev libssl-dev zlib1g-dev libsqlite3-dev libxlsxwriter-dev)
for part in "$@"; do
    case "$part" in
        tests) packages+=(libgtest-dev) ;;
        coverage) packages+=(gcovr) ;;
        package) packages+=(dpkg-dev file) ;;
        python) packages+=(python3-dev pybind11-dev python3-numpy python3-pandas python3-vtk9) ;;
        reports) packages+=(chromium) ;;
        office) packages+=(libreoffice-calc-nogui) ;;
        notebook) packages+=(jupyter-nbconvert python3-ipykernel) ;;
    esac
done
missing=()
for p in "${packages[@]}"; do
    dpkg-query -W -f='${Status}' "$p" 2>/dev/null | grep -q 'ok installed' || missing+=("$p")
done
[ ${#missing[@]} -eq 0 ] && exit 0
sudo=()
if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || { echo "setup: these packages are missing and neither root nor sudo is at hand: ${missing[*]}" >&2; exit 1; }
    sudo=(sudo)
fi
echo "setup: installing ${missing[*]}" >&2
export DEBIAN_FRONTEND=noninteractive
"${sudo[@]}" apt-get update -qq >&2
"${sudo[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}" >&2
