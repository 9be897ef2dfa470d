#!/bin/bash
# Whether two programs do the same: runs the jobs of same_output.jobs with both and compares all that
# they make, byte for byte: files, standard output, standard error, exit codes. For refactoring.
#
#   same_output.sh OLD_WEFT NEW_WEFT [FILTER]
#
# OLD_WEFT and NEW_WEFT are programs in build directories, whose libraries and Python package are
# tried too; FILTER is a regular expression that the names of jobs must match. What differs is told
# in a line a job and a short diff, and the exit code is 1. What the old program made is kept in
# $SAME_CACHE (/tmp/same_output.$UID), in a folder for each version of it and of this script, so that
# only the new one runs the next time; so are the new results of the jobs that differed, to look at.
# $SAME_JOBS jobs (2) run at once, each for $SAME_TIMEOUT seconds (60) at most. $WEFT_SHARED is the
# directory of sample data, as for the tests. It needs a C compiler, oiiotool, ffmpeg, and a Python that has NumPy.
set -u
unset OCIO
export OMP_WAIT_POLICY=passive LC_ALL=C.UTF-8 NO_COLOR=1 PYTHONDONTWRITEBYTECODE=1

die() { echo "same_output.sh: $*" >&2; exit 2; }

[ $# = 2 ] || [ $# = 3 ] || die "usage: same_output.sh OLD_WEFT NEW_WEFT [FILTER]"
here=$(cd "$(dirname "$0")" && pwd)
old=$(realpath -e "$1") || exit 2
new=$(realpath -e "$2") || exit 2
filter=${3:-.}
for python in /usr/bin/python3 python3; do "$python" -c 'import numpy' 2>/dev/null && break; done
export SAME_PYTHON=$python SAME_HERE=$here SAME_TIMEOUT=${SAME_TIMEOUT:-60}
WEFT_SHARED=$(realpath -m "${WEFT_SHARED:-$here/../../../shared}")/data
export WEFT_SHARED

# source_of PROGRAM: the source tree that its build directory is of.
source_of() { sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$(dirname "$1")/CMakeCache.txt"; }

# identity: a sum over this script, what is beside it and the old program with all it loads.
identity()
{
    local build
    build=$(dirname "$old")
    {
        cat "$here"/same_output*.*
        find -L "$old" "$build"/lib*/ -type f ! -name '*.pyc' ! -name '*.a' | sort | xargs sha256sum
    } | sha256sum | cut -c 1-16
}

# ---- Inputs, once ----

# tries_compressions FROM TO: OpenEXR's compressions and tiles, a subframe each.
tries_compressions()
{
    local k=0 how
    mkdir -p "$2"
    for how in none rle zips zip piz pxr24 b44 b44a dwaa dwab "zip --tile 32 32" "piz --tile 16 48" \
        "dwaa --tile 64 64" "none -d float" "zips -d float" "pxr24 -d float"; do
        # shellcheck disable=SC2086
        oiiotool "$1/s.$(printf %04d $k).exr" --compression $how -o "$2/s.$(printf %04d $k).exr"
        k=$((k + 1))
    done
}

# other_formats FROM: eight subframes in what is no EXR, and as the second part of several.
other_formats()
{
    local k from
    mkdir -p png tif dpx jpg parts
    for k in 0 1 2 3 4 5 6 7; do
        from=$1/s.000$k.exr
        oiiotool "$from" --colorconvert linear sRGB -d uint8 -o "png/s.000$k.png" -o "jpg/s.000$k.jpg"
        oiiotool "$from" --colorconvert linear sRGB -d uint16 -o "tif/s.000$k.tif"
        oiiotool "$from" --colorconvert linear sRGB -d uint10 -o "dpx/s.000$k.dpx"
        oiiotool "$from" --flip --attrib oiio:subimagename upside "$from" --attrib oiio:subimagename upright \
            --siappend -o "parts/s.000$k.exr"
    done
}

# deep_compressions FROM: a sample buffer in each, and one of half floats.
deep_compressions()
{
    local how
    mkdir -p deeps
    for how in none rle zips zip; do oiiotool "$1" --compression $how -o deeps/$how.0000.exr; done
    oiiotool "$1" -d half --compression zips -o deeps/half.0000.exr
}

# cut_pictures: pictures of other formats that end early, or have a byte changed.
cut_pictures()
{
    local kind size
    mkdir -p cut
    for kind in png jpg tif dpx; do
        size=$(stat -c %s $kind/s.0000.$kind)
        head -c $((size * 2 / 3)) $kind/s.0000.$kind >cut/end.0000.$kind
        head -c 40 $kind/s.0000.$kind >cut/begin.0000.$kind
    done
    { head -c 1000 png/s.0000.png; printf x; tail -c +1002 png/s.0000.png; } >cut/sum.0000.png
}

# numbers FROM: names with gaps, quarters, steps, no padding and two kinds in one folder, by links.
numbers()
{
    local k
    mkdir -p gaps quarters tens bare mixed alone
    ln -s "$(realpath timed.exr)" alone/shot.exr
    for k in $(seq 0 15); do
        local from
        from=$(realpath "$1/s.$(printf %04d "$k").exr")
        [ "$k" = 5 ] || [ "$k" = 6 ] || ln -s "$from" "gaps/s.$(printf %04d "$k").exr"
        ln -s "$from" "quarters/s.$((1001 + k / 4)).$(printf %02d $((k % 4 * 25))).exr"
        ln -s "$from" "tens/s.$(printf %05d $((k * 10))).exr"
        ln -s "$from" "bare/s.$((k + 1)).exr"
        ln -s "$from" "mixed/$([ $((k % 2)) = 0 ] && echo a || echo b).$(printf %02d $((k / 2))).exr"
    done
}

# video NAME OPTION..: the large subframes as video of the old program's.
video() { "$old" convert sub --subframe-rate 400 --aperture box --temporal-width 0 --fit stretch -q -o "$@"; }

videos()
{
    mkdir v
    video v/525i.y4m --raster 525i
    video v/525i-8.y4m --raster 525i --bits 8
    video v/525i-notch.y4m --raster 525i --aperture notch
    video v/625i.y4m --raster 625i
    video v/525i.v210 --raster 525i
    video v/525i.uyvy --raster 525i
    video v/525i.####.dpx --raster 525i
    video v/525i.mov --raster 525i --audio silent:2 --timecode '01:00:00;00'
    video v/prores.mov --raster 1080i50 --codec prores --timecode 10:00:00:00
    video v/xdcam.mxf --raster 1080i50 --audio silent:8 --timecode 10:00:00:00
    video v/imx.mxf --raster 525i-imx --codec imx50 --audio silent:4
    video v/raw.mxf --raster 625i --codec v210 --audio silent:1
    video v/ffv1.mkv --raster 625i --timecode 10:00:00:00
    "$old" render scenes/zoneplate.lua -q --raster 525i --samples 4 --aperture line --frames 0 -o v/zone.####.exr
    "$old" render scenes/carousel.lua -q --raster 180x122@29.97i,bff --samples 2 --cadence 2:3 --frames 0-7 \
        --bits 8 -o v/film.y4m
    head -c 1000000 v/525i.y4m >v/cut.y4m
    head -c 1500000 v/prores.mov >v/cut.mov
    head -c 100000 v/ffv1.mkv >v/cut.mkv
    sed '1s/ Ib / It /' v/525i.y4m >v/flag.y4m
    sed '1s/W720/W702/' v/525i.y4m >v/width.y4m
    sed '1s/F30000:1001/F0:0/' v/525i.y4m >v/rate.y4m
    ffmpeg -nostdin -v error -f lavfi -i testsrc=s=720x576:r=25:d=0.2 -pix_fmt yuv422p -c:v mpeg2video -qscale 3 \
        -threads 1 v/other.mpg
}

make_inputs()
{
    local source
    source=$(source_of "$old")
    cp -r "$source/examples/scenes" scenes
    mkdir tools
    find "$source/examples" "$source/tests" \( -name write_samples.py -o -name patch_delivery.py \) -exec cp {} tools \;
    "$(dirname "$old")/make_subframes" sub 32 || return 1
    mkdir small deep
    "$old" trace scenes/carousel.lua -q --raster 96x64@30i,tff --samples 1 --frames 0-3 --oversample 2x2x4 \
        -o small/s.####.exr || return 1
    "$old" trace scenes/carousel.lua -q --raster 48x32@30i,tff --samples 6 --frames 0-1 -o deep/s.####.exr || return 1
    "$old" trace scenes/carousel.lua -q --raster 48x32@30i,tff --samples 1 --frames 0 -o deep/thin.####.exr || return 1
    "$python" "$here/same_output_inputs.py" . || return 1
    tries_compressions small compressed
    other_formats small
    numbers small
    deep_compressions deep/s.0000.exr
    cut_pictures
    videos
    cc -std=c17 -O1 -I "$source/convert" "$here/same_output_push.c" -o push -L "$(dirname "$old")/lib" -lweft -lm ||
        return 1
    [ ! -d "$WEFT_SHARED" ] || ln -s "$WEFT_SHARED" shared
}

# ---- Jobs ----

# prelude: what all jobs may use: the program, subframes of 96x64 pixels as video, a scene as small
# video, same_output_push.c built against the library, and lines of command lines, each printed before
# it runs.
prelude()
{
    cat <<'END'
raster=96x64@30i,tff
weft() { local code; "$WEFT" "$@"; code=$?; [ $code = 0 ] || echo "exit code $code: weft $*" >&2; return $code; }
small() { weft convert in/small --raster $raster "$@"; }
scene()
{
    local name=$1
    shift
    weft render "in/scenes/$name.lua" --raster 60x42@30i,tff,par=10:11 --frames 0-1 --samples 3 "$@"
}
build_program()
{
    cc -std=c17 -O1 -I "$WEFT_SOURCE/convert" "$SAME_HERE/same_output_push.c" -o ../program \
        -L "$WEFT_BUILD/lib" -lweft -lm
}
program() { LD_LIBRARY_PATH=$WEFT_BUILD/lib ../program "$@"; }
lines() { local line; while read -r line; do echo "# $line"; echo "# $line" >&2; eval "weft $line"; done; }
END
}

# snippet NAME: the lines of the table that belong to it. A row begins with NAME: and goes on with
# the lines that are indented.
snippet()
{
    awk -v name="$1" '/^[^ #]/ { at = index($0, ": "); on = substr($0, 1, at - 1) == name
        if (on) print substr($0, at + 2) } /^ / && on { print substr($0, 5) }' "$here/same_output.jobs"
}

names() { sed -n 's/^\([a-z0-9.-]*\): .*/\1/p' "$here/same_output.jobs"; }

# run_job NAME RESULTS: in a fresh directory of the same name for both programs, then moved.
run_job()
{
    local name=$1 to=$2/$1
    rm -rf "run/$name" "$to"
    mkdir -p "run/$name/files"
    ln -s ../../../in "run/$name/files/in"
    (
        cd "run/$name/files" || exit
        { prelude; snippet "$name"; } >../job.sh
        TIMEFORMAT='%R %U %S' # for whoever wants to know which jobs are slow
        time timeout -k 5 "$SAME_TIMEOUT" bash ../job.sh >../stdout 2>../stderr </dev/null
        echo $? >../exit
    ) 2>"run/$name/seconds"
    rm -f "run/$name/files/in" "run/$name/job.sh" "run/$name/program"
    mv "run/$name" "$to"
}

# run_jobs PROGRAM RESULTS: those of the names on standard input that are not there.
run_jobs()
{
    mkdir -p "$2" run
    ln -sfn "$(dirname "$1")" build
    WEFT=$PWD/build/$(basename "$1") WEFT_BUILD=$PWD/build WEFT_SOURCE=$(source_of "$1")
    export WEFT WEFT_BUILD WEFT_SOURCE
    xargs -P "${SAME_JOBS:-2}" -I {} bash -c "[ -e '$2/{}' ] || run_job '{}' '$2'"
}

export -f run_job snippet prelude
export here
key=${SAME_CACHE:-/tmp/same_output.$UID}/$(identity)
mkdir -p "$key" && cd "$key" || exit 2
exec 9>lock
flock 9 || exit 2
if [ ! -e inputs.done ]; then
    rm -rf in
    mkdir in
    (cd in && make_inputs) 9>&- || die "the inputs could not be made"
    touch inputs.done
fi
absent='^$' # names of jobs that cannot run
[ -d "$WEFT_SHARED" ] || absent='^shared\.'
names | grep -E -- "$filter" | grep -vE "$absent" >wanted
[ -s wanted ] || die "no job matches $filter"
run_jobs "$old" old <wanted 9>&-
rm -rf new
run_jobs "$new" new <wanted 9>&-
"$python" "$here/same_output.py" "$key/old" "$key/new" <wanted
