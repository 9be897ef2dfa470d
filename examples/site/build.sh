#!/bin/bash
# Builds weft's site: build.sh BUILD_DIR makes BUILD_DIR/html of the pages in the repository, of what the program says
# of its options, and of the header and the Python package. WEFT names the program, build/weft if it is not set.
set -eu
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source=$(cd "$here/../.." && pwd)
[ $# = 1 ] || { echo "usage: $0 BUILD_DIR" >&2; exit 2; }
WEFT=$(realpath "${WEFT:-$source/build/weft}")
[ -x "$WEFT" ] || { echo "$WEFT is not there: build weft first, or say where it is with WEFT=" >&2; exit 1; }
for program in mkdocs doxygen; do
    command -v $program >/dev/null || { echo "no $program: apt-get install $program" >&2; exit 1; }
done
mkdir -p "$1"
build=$(cd "$1" && pwd)
rm -rf "$build/pages" "$build/html" "$build/api"
export WEFT
python3 -B "$here/stage.py" "$source" "$build"
(cd "$source/convert" && doxygen - < <(cat "$here/Doxyfile"; echo "OUTPUT_DIRECTORY = $build/api"
    echo "INPUT_FILTER = \"sed -E -f $here/comments.sed\""
    echo "PROJECT_NUMBER = $("$WEFT" --version | cut -d ' ' -f 2)"))
mkdocs build -q --strict -f "$build/mkdocs.yml" -d "$build/html"
mv "$build/api/html" "$build/html/api"
rm -r "$build/api"
rm -f "$build/html"/sitemap.xml*  # It wants an address, which a site that is built anywhere has not.
echo "$build/html/index.html"
