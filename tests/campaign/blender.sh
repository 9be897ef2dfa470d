#!/bin/bash
# The Blender add-on with Blender itself, as tests/plan/test_blender.sh tries it: a failure where it skips what it needs.
set -eu
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
command -v blender >/dev/null || { echo "skipped: no blender"; exit 77; }
build=${WEFT_BUILD:-$source_dir/build}
WEFT=$build/weft WEFT_BUILD=$build WEFT_SOURCE=$source_dir WEFT_LONG=1 bash "$source_dir/tests/plan/test_blender.sh"
