#!/bin/bash
# The tracer beside POV-Ray 3.7 on one scene, two threads each: tracer.sh BUILD [RUNS].
# Prints camera and shadow rays a second of both and their ratio; medians of RUNS.
set -eu
build=$(cd "$1" && pwd)
runs=${2:-5}
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

median() { sort -n | awk '{ v[NR] = $1 } END { print v[int((NR + 1) / 2)] }'; }

# weft: the pixels of one progressive picture, 60 samples each, with everything that follows.
ours()
{
    "$build/weft" render "$here/../../examples/scenes/carousel.lua" --raster 720x486@30p,par=10:11 \
        --aperture line --temporal-width 0 --samples 60 --frames 0 --threads 2 --overwrite \
        -o ours.y4m --report ours.json
    awk -F'[:,]' '/"tracer"/ { for (i = 1; i < NF; i++) if ($i ~ /"rays"/) rays = $(i + 1) }
        /"seconds"/ { for (i = 1; i < NF; i++) if ($i ~ /"wall"/) wall = $(i + 1) }
        END { print rays / wall }' ours.json
}

theirs()
{
    cp "$here/../peers/carousel.pov" .
    povray +Icarousel.pov +Otheirs.png +W720 +H486 +AM1 +A0.0 +R8 -J +WT2 -D 2>&1 | tr '\r' '\n' |
        awk '/^Rays:/ { rays = $2 } /Shadow Ray Tests:/ { rays += $4 }
            /Trace Time:/ { sub(/.*\(/, ""); time = $1 } END { print rays / time }'
}

for ((n = 0; n < runs; n++)); do
    ours >>ours.txt
    if command -v povray >/dev/null; then theirs >>theirs.txt; fi
done
echo "weft     $(median <ours.txt | awk '{ printf "%.1f", $1 / 1e6 }') million rays a second"
if [ ! -s theirs.txt ]; then
    echo "POV-Ray  is not installed"
    exit 0
fi
echo "POV-Ray  $(median <theirs.txt | awk '{ printf "%.1f", $1 / 1e6 }') million rays a second"
echo "ratio    $(paste ours.txt theirs.txt | awk '{ print $1 / $2 }' | median)"
