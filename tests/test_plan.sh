#!/bin/bash
# weft convert --dry-run: what it says against what the run's own report says, over rasters, widths,
# chunks, missing subframes and half a sequence resumed; and that nothing is written.
. "$WEFT_SOURCE/tests/script.sh"

check "subframes" exits 0 weft trace "$WEFT_SOURCE/examples/scenes/carousel.lua" --raster 24x16@30i,tff \
    --samples 1 --frames 0-5 --oversample 1x1x4 -q -o shot.####.exr

# foretold OPTION..: the dry run's plan and the run's report agree, and only the second writes.
foretold()
{
    local before
    before=$(find . -name 'made*' | sort)
    weft convert shot.####.exr "$@" --dry-run --report plan.json >said 2>&1 || [ $? = 3 ] || { cat said; return 1; }
    [ "$before" = "$(find . -name 'made*' | sort)" ] || { echo "the dry run has written"; return 1; }
    weft convert shot.####.exr "$@" -q --report run.json 2>/dev/null || [ $? = 3 ] || return 1
    python3 - <<'PY' || { echo "weft convert $*"; return 1; }
import json, sys
plan, run = json.load(open('plan.json')), json.load(open('run.json'))
p = plan['plan']
told = [p['frames'], len(p['fields']), p['opened']]
done = [run['frames'], run['fields'], run['input']['opened']]
if told != done or plan['frames'] or plan['input']['opened']:
    sys.exit(f'told {told}, done {done}')
PY
}

for raster in 24x16@30i,tff 24x16@25i,bff 24x16@30psf; do
    for width in 0 3; do
        check "$raster, width $width" foretold --raster $raster --temporal-width $width \
            --overwrite -o made.v210
    done
done
for chunk in 1/3 2/3 3/3; do
    check "chunk $chunk" foretold --raster 24x16@30i,tff --chunk $chunk --overwrite -o made.y4m
done
rm made.*
check "a sequence" foretold --raster 24x16@30i,tff -o made.#.exr
rm made.0001.exr made.0004.exr
check "the rest of a sequence" foretold --raster 24x16@30i,tff --resume -o made.#.exr
check "the rest is two frames" grep -q '"frames": 2' run.json
check "an output that is there" exits 0 weft convert shot.####.exr --raster 24x16@30i,tff -o made.#.exr --dry-run
check "it would be refused" prints "6 there already (refused)"
check "long runs are cut" prints "  ..."

# The bytes are those of the files that are needed: one frame's subframes.
check "bytes" exits 0 weft convert shot.####.exr --raster 24x16@30i,tff --temporal-width 1 --chunk 1/6 \
    --dry-run --report - -o new.y4m
want=$(stat -c %s shot.000[0-7].exr | awk "{ n += \$1 } END { print n }")
check "bytes to read" value "d['plan']['bytes_to_read'] == $want and d['plan']['files'] == 8"
check "nothing there" value "d['plan']['present'] == 0"

rm shot.0003.exr
check "missing" exits 1 weft convert shot.####.exr --raster 24x16@30i,tff \
    --temporal-width 1 -o new.y4m --dry-run
check "missing ones are named" says "subframe 3 is missing"
check "held" foretold --raster 24x16@30i,tff --temporal-width 1 --on-missing hold --overwrite -o made.y4m
check "black" foretold --raster 24x16@30i,tff --temporal-width 1 --on-missing black --overwrite -o made.y4m
check "not for render" exits 2 weft render x.lua -o y.y4m --dry-run
check "nothing was written" test ! -e new.y4m
finish
