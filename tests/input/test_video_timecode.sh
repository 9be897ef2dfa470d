#!/bin/bash
# Timecode of the input video is that of the output, whose frame 0 is called as the picture that it begins with.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "test_jobs.sh converts"
needs_libav
needs ffmpeg python3

coded() { quiet_ffmpeg -f lavfi -i testsrc2=s=64x32:r=$2:d=2 -pix_fmt yuv420p "${@:3}" "$1"; }
box="--from rec709 --raster 64x32@25i --aperture box --bits 8 -q --overwrite"

# label FILE: the timecode of a frame of DPX (ST 268-1 has it at 1920).
label() { od -An -tx1 -j1920 -N4 "$1" | tr -d ' \n'; }

# begins CODE FILE [OPTION..]: the first frame that comes of it has this label.
begins()
{
    local code=$1 file=$2
    shift 2
    rm -f o.*.dpx
    exits 0 weft convert "$file" $box "$@" -o o.####.dpx --report - || return 1
    same "$(label "$(ls o.*.dpx | head -1)")" "$code"
}

coded film.mov 25 -c:v libx264 -timecode 01:02:03:04
coded film.mxf 25 -c:v mpeg2video -timecode 01:02:03:04
coded film.mkv 25 -c:v ffv1 -metadata timecode=01:02:03:04
coded film.mpg 25 -c:v mpeg2video -timecode 01:02:03:04
for file in film.mov film.mxf film.mkv film.mpg; do
    check "$file" begins 01020304 $file
    check "is told" value "d['input']['timecode'] == {'value': '01:02:03:04', 'reason': 'file'}"
done
check "another" begins 10000000 film.mov --timecode 10:00:00:00
check "some frames" begins 01020314 film.mov --output-frames 10-20
check "some pictures" begins 01020409 film.mov --frames 30-49
check "a chunk" begins 01020404 film.mov --chunk 2/2
check "a pipe" begins 01020304 <(cat film.mkv)
coded fast.mov 50 -c:v libx264 -timecode 01:02:03:44
check "of 50, at 25 frames" begins 01020322 fast.mov
check "and later" begins 01020405 fast.mov --frames 16-99
coded fields.mov 60000/1001 -c:v libx264 -timecode '00:59:59;58'
check "drop frame" begins 00595969 fields.mov --raster '64x32@30000/1001i,bff'
coded none.mpg 25 -c:v mpeg2video
check "none" begins 00000000 none.mpg
check "is not told" value "'timecode' not in d['input']"

finish
