#!/bin/bash
# The quick start in a Debian 12 that has nothing but its base, then `cmake --install`, and the C and Python
# of README.md as printed. Wants root, and a mirror of Debian.
set -eu
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
. "$source_dir/tests/campaign/root.bash"
wants_root
make_root "" --include=ca-certificates
put_source
in_root <<'END'
set -eux
cd /weft
examples/quickstart.sh
cmake --install build
printed() { sed -n "/^\`\`\`$1\$/,/^\`\`\`\$/p" README.md | sed '/^```/d'; }
printed c >shot.c
eval "$(grep '^ *cc shot.c ' README.md)"
./a.out
apt-get -qq install -y --no-install-recommends python3-numpy
printed python >shot.py
python3 shot.py
weft info out/shot_625i.y4m out/shot.y4m
weft --version
END
