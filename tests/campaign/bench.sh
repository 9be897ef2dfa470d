#!/bin/bash
# Every target of speed, and POV-Ray beside weft's tracer, at full size.
set -eu
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
exec python3 -B "$source_dir/tests/bench/run.py" "${WEFT_BUILD:-$source_dir/build}"
