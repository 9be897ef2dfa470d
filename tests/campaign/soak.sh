#!/bin/bash
# Hundreds of rounds of jobs in one Python, whose memory does not grow. COUNT (300) is its argument.
set -u
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
build=${WEFT_BUILD:-$source_dir/build}
python=
for candidate in /usr/bin/python3 python3; do
    "$candidate" -c 'import numpy' 2>/dev/null && python=$candidate && break
done
[ -n "$python" ] || { echo "skipped: no Python with NumPy"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
PYTHONPATH=$build/lib/python3/dist-packages WEFT_SOURCE=$source_dir "$python" "$source_dir/tests/hard/soak.py" "${1:-300}"
