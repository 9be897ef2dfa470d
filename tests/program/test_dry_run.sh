#!/bin/bash
# --dry-run: what it says against what the run's own report says and the files that it leaves, over
# rasters, widths, chunks, kinds of output, missing subframes and half a sequence resumed; and that
# nothing is written.
. "$WEFT_SOURCE/tests/program/script.sh"

scene=$WEFT_SOURCE/examples/scenes/carousel.lua
raster=24x16@30i,tff
check "subframes" exits 0 weft trace "$scene" --raster $raster --samples 1 --frames 0-5 \
    --oversample 1x1x4 -q -o shot.####.exr

# agrees COMMAND OPTION..: what the plan and the run's report say is kept for comparing, and which
# files there were before and after; the dry run may not make any.
runs=0
agrees()
{
    case ${*: -1} in *.dpx) has_module oiio || { skip_part "DPX: weft was built without OpenImageIO"; return; } ;; esac
    runs=$((runs + 1))
    echo "weft $*" >words.$runs
    stat -c '%n %s' made* >before.$runs 2>/dev/null
    weft "$@" --dry-run --report plan.$runs >said 2>&1 || [ $? = 3 ] || { cat said; return 1; }
    stat -c '%n %s' made* >between 2>/dev/null
    cmp -s before.$runs between || { echo "the dry run has written"; return 1; }
    weft "$@" -q --report run.$runs 2>said || [ $? = 3 ] || { cat said; return 1; }
    stat -c '%n %s' made* >after.$runs 2>/dev/null
    true
}

# All of these at once: Python takes longer to begin than weft to run.
cat >compare.py <<'PY'
import json, sys
def files(name):
    return dict(line.split() for line in open(name))
def compare(n):
    plan, run = json.load(open(f'plan.{n}')), json.load(open(f'run.{n}'))
    p, before, after = plan['plan'], files(f'before.{n}'), files(f'after.{n}')
    told = [p['frames'], 0 if run['command'] == 'trace' else p['fields_made'], p.get('opened', 0)]
    done = [run['frames'], run['fields'], run['input']['opened']]
    if told != done or plan['frames'] or plan['input']['opened'] or plan['raster'] != run['raster']:
        return f'told {told}, done {done}'
    if 'samples' in p and p['samples'] != run['tracer']['samples']:
        return f"{p['samples']} samples told, {run['tracer']['samples']} taken"
    made = sorted(set(after) - set(before))
    size = sum(int(after[name]) for name in made)
    ends = [p[end].removeprefix('hash:') for end in ('first_output', 'last_output')] if made else []
    if p['outputs'] != len(made) or (made and ends != [made[0], made[-1]]):
        return f"told {p['outputs']} files, {ends}; made {made}"
    known, bytes = p['bytes_known'], p.get('bytes_to_write', 0)
    good = {'exact': size == bytes, 'at most': size <= bytes, 'not known': True,
            'about': abs(size - bytes) < .02 * size + 65536}
    return None if good[known] else f'told {known} {bytes} bytes, made {size}'
wrong = 0
for n in range(1, int(sys.argv[1]) + 1):
    why = compare(n)
    wrong += why is not None
    if why: print(open(f'words.{n}').read() + why)
sys.exit(wrong > 0)
PY

# foretold OPTION..: of a conversion of the subframes, to files that are not there yet.
foretold() { agrees convert shot.####.exr --raster $raster "$@"; }
fresh() { rm -f made.*; foretold "$@"; }

check "Y4M" fresh --temporal-width 3 -o made.y4m
check "a later chunk" fresh --chunk 2/3 -o made.y4m
check "DPX of fields" fresh --fields separate --raster 23x18@30i,bff --temporal-width 0 --bits 12 -o made.#.dpx
check "pulldown" fresh --raster 24x16@30i,bff --subframe-rate 96 --cadence 2:3 --bits 8 -o made.v.y4m
if ! is_sanitized; then # the same paths
    check "25 frames" fresh --raster 24x16@25i,bff --bits 8 -o made.uyvy
    check "segmented" fresh --raster 24x16@30psf --temporal-width 0 -o made.v210
    check "a hash" fresh --chunk 3/3 -o hash:made.txt
    for bits in 8 10 16; do
        check "DPX of $bits bits" fresh --frames 0-7 --raster 23x18@30i,bff --bits $bits -o made.#.dpx
    done
    check "PNG" fresh --frames 0-15 -o made.#.png
    if has_libav; then
        check "a container" fresh --frames 0-8 --raster 525i --audio silent:2 -o made.mov
        check "a coded one" fresh --raster 24x16@30i,tff --codec ffv1 -o made.mkv
    fi
    check "MXF" fresh --frames 0-8 --raster 525i --codec v210 --audio silent:2 -o made.mxf
    rm made.*
    check "a scene" agrees render "$scene" --raster $raster --samples 2 --skip off --frames 0-2 \
        --temporal-width 2 -o made.y4m
fi
rm -f made.*
check "sample buffers" agrees trace "$scene" --raster $raster --samples 2 --skip off --frames 1-2 -o made.#.exr
check "their frames" exits 0 weft convert made.#.exr --raster $raster -o new.y4m --dry-run --report -
check "are told" value "d['plan']['frames'] == 2 and d['plan']['outputs'] == 1"
rm made.*
check "traced subframes" agrees trace "$scene" --raster $raster --oversample 2x1x2 --frames 1 -o made.#.exr

# ---- What is there already ----

check "a sequence" fresh -o made.#.exr
rm made.0001.exr made.0004.exr
check "the rest of a sequence" foretold --resume -o made.#.exr
check "the rest is two frames" grep -q '"frames": 2' run.$runs
check "nothing is left of it" foretold --resume -o made.#.exr
check "an output that is there" exits 0 weft convert shot.####.exr --raster $raster -o made.#.exr --dry-run
check "it would be refused" prints "6 there already (refused)"
check "long runs are cut" prints "  ..."
check "names are told" prints "made.0000.exr .. made.0005.exr (6)"
check "times are told" prints "field 1: 0.016667 to 0.025000 s"
check "a whole stream" fresh -o made.y4m
check "is done" foretold --resume -o made.y4m
cp plan.$runs out
check "nothing of it is made" value "d['plan']['outputs'] == 0 and d['plan']['bytes_to_write'] == 0"

# The bytes are those of the files that are needed: one frame's subframes.
check "bytes" exits 0 weft convert shot.####.exr --raster $raster --temporal-width 1 --chunk 1/6 \
    --dry-run --report - -o new.y4m
want=$(stat -c %s shot.000[0-7].exr | awk "{ n += \$1 } END { print n }")
check "bytes to read" value "d['plan']['bytes_to_read'] == $want and d['plan']['files'] == 8"
check "nothing there" value "d['plan']['present'] == 0"
check "windows" value "[(round(f['from_s'] * 60, 6), round(f['to_s'] * 60, 6)) for f in d['plan']['fields']] == [(0, 1), (1, 2)]"

# ---- What is missing ----

rm shot.0003.exr
check "missing" exits 1 weft convert shot.####.exr --raster $raster --temporal-width 1 -o new.y4m --dry-run
check "missing ones are named" says "subframe 3 is missing"
check "held" fresh --temporal-width 1 --on-missing hold -o made.y4m
check "black" fresh --temporal-width 1 --on-missing black -o made.y4m
check "nothing was written" test ! -e new.y4m
check "plans are what runs do" python3 compare.py $runs
finish
