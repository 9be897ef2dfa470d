#!/bin/bash
# The page of examples/paper with every sample, and what a browser shows of it.
set -eu
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
chromium=$(command -v chromium) || { echo "skipped: no chromium"; exit 77; }
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
WEFT=${WEFT_BUILD:-$source_dir/build}/weft "$source_dir/examples/paper/run.sh" -o "$out"
python3 -B "$source_dir/tests/page/paper_page.py" "$out/index.html" "$chromium"
