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

# time_code FROM TO HH:MM:SS:FF DROP: an SEI of that (Rec. ITU-T H.265, D.2.27) before the first picture of HEVC.
time_code()
{
    python3 - "$@" <<'P'
import sys
h, m, s, f = map(int, sys.argv[3].split(":"))
drop = int(sys.argv[4])
bits = "0110" + format(4 * drop, "05b") + "10" + str(drop)
bits += format(f, "09b") + format(s, "06b") + format(m, "06b") + format(h, "05b") + "00000" + "1"
bits += "0" * (-len(bits) % 8)
unit = bytes([39 << 1, 1, 136, len(bits) // 8]) + int(bits, 2).to_bytes(len(bits) // 8, "big") + b"\x80"
data = open(sys.argv[1], "rb").read()
first = next(at for at in range(len(data)) if data[at:at + 3] == b"\0\0\1" and data[at + 3] >> 1 < 32)
open(sys.argv[2], "wb").write(data[:first] + b"\0\0\1" + unit.replace(b"\0\0", b"\0\0\3") + data[first:])
P
}
if ffmpeg -v error -encoders | grep -q libx265; then
    coded plain.hevc 25 -c:v libx265 -x265-params log-level=error:bframes=0
    time_code plain.hevc sei.hevc 10:11:12:13 0
    check "SEI of HEVC" begins 10111213 sei.hevc
    check "is told" value "d['input']['timecode'] == {'value': '10:11:12:13', 'reason': 'file'}"
    quiet_ffmpeg -r 25 -i sei.hevc -c copy sei.mp4
    check "in MP4" begins 10111213 sei.mp4
else
    skip_part "no libx265"
fi

finish
