#!/bin/bash
# Flicker against distance after displays, of every way to make fields, on twelve scenes and three rasters.
set -eu
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
exec python3 -B "$source_dir/tests/bench/defaults.py" "${WEFT_BUILD:-$source_dir/build}"
