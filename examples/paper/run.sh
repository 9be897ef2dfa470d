#!/bin/bash
# Renders and measures all of the paper again and writes a page about it, out/paper/index.html:
# run.sh [--quick] [-o FOLDER]. WEFT names the program; default: build/weft of this repository.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
weft=${WEFT:-$here/../../build/weft}
out=$here/../../out/paper
options=()
usage="usage: run.sh [--quick] [-o FOLDER]"

while [ $# -gt 0 ]; do
    case $1 in
        --quick) options+=(--quick) ;;
        -o) [ $# -gt 1 ] || { echo "run.sh: -o needs a folder. $usage" >&2; exit 2; }
            out=$2
            shift ;;
        -h | --help) echo "$usage"; exit 0 ;;
        *) echo "run.sh: unknown option $1. $usage" >&2; exit 2 ;;
    esac
    shift
done
if ! command -v "$weft" >/dev/null; then
    echo "run.sh: there is no program $weft; build weft first, or name it in WEFT" >&2
    exit 1
fi
exec python3 -B "$here/build.py" --weft "$weft" --out "$out" "${options[@]}"
