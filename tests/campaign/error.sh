#!/bin/bash
# Whether --error keeps what it says, on scenes made to fool it and on those that ship.
set -eu
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
exec python3 -B "$source_dir/tests/bench/error.py" "${WEFT_BUILD:-$source_dir/build}"
