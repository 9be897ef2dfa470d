#!/bin/bash
# weft verify: files that are right, by weft and by others; and for every check a file that fails it and no
# other.
. "$WEFT_SOURCE/tests/program/script.sh"

not_sanitized "test_jobs.sh verifies"
needs_libav
needs ffmpeg
subframes in 32

# coding FILE OFFSET: that byte of MPEG-2's first picture coding extension, with the other order of fields.
coding()
{
    python3 -c 'import sys
data = open(sys.argv[1], "rb").read()
print("%02x" % (data[data.index(b"\0\0\1\xb5\x8f") + 4 + int(sys.argv[2])] ^ 0x80))' "$@"
}

# ---- What weft delivers is right ----

check "v210" made a.mov --codec v210 --raster 525i --timecode "01:00:00;00" --audio silent:2
check "is right" right a.mov --profile v210-525
check "XDCAM" made x.mxf --codec xdcamhd422 --raster 1080i50 --timecode 10:00:00:00 --audio silent:8
check "is right" right x.mxf --profile xdcamhd422-1080i50
check "and for a station" right x.mxf --profile as-hdf01a
check "D-10" made i.mxf --codec imx50 --raster 525i-imx --timecode 00:00:00:00 --audio silent:4
check "is right" right i.mxf --profile imx50-525
check "ProRes" made p.mov --codec prores --raster 1080i50 --timecode 10:00:00:00
check "is right" right p.mov --profile prores-1080i50
check "FFV1" made f.mkv --codec ffv1 --raster 625i --timecode 10:00:00:00
check "is right" right f.mkv --profile ffv1-archive
check "Y4M" made y.y4m --raster 625i
check "is right" right y.y4m --raster 625i
check "DPX" made d.####.dpx --raster 525i
check "is right" right d.####.dpx --raster 525i

# ---- Each check fails ----

head -c 1500000 y.y4m >cut.y4m
check "reading" only reading cut.y4m
quiet_ffmpeg -i p.mov -map 0:v -c copy -timecode 10:00:00:00 p.mkv
check "container" only container p.mkv --profile prores-1080i50
check "prores of 525" made p5.mov --codec prores --raster 525i --timecode "01:00:00;00"
check "codec" only codec p5.mov --profile v210-525
check "size" only size y.y4m --raster 720x574@25i,tff,par=12:11,601-625
check "rate" only rate y.y4m --raster 720x576@30i,tff,par=12:11,601-625
sed '1s/ It / Ib /' y.y4m >flags.y4m
check "flags" only flags flags.y4m --raster 625i
check "bottom first" made n.y4m --raster 525i
sed '1s/ Ib / It /' n.y4m >order.y4m
check "order" only order order.y4m --raster 720x486@29.97i,tff,par=10:11,601-525
check "aspect" only aspect a.mov --raster 525i-wide
check "colors" wrong colors a.mov atom colr 4 000100010001
check "fiel" wrong fiel a.mov atom fiel 0 0206 --raster 525i
check "atoms" wrong atoms p.mov atom pasp -4 66726565
check "clap" wrong clap a.mov atom clap 0 000002d0
check "pattern" wrong pattern i.mxf label - 13 02
check "layout" wrong layout i.mxf item 320c 0 04
check "line map" wrong "line map" i.mxf item 320d 8 0000001500000100
check "dominance" wrong dominance i.mxf item 3212 0 02
check "siting" wrong siting i.mxf item 3303 0 03
check "fields of MPEG-2" wrong coded i.mxf picture - 3 "$(coding i.mxf 3)"
check "aspect of MXF" wrong aspect i.mxf item 320e 0 0000001000000009 --raster 525i-imx
check "base" wrong base i.mxf item 1502 0 0019
check "base of QuickTime" wrong base p.mov atom tmcd 24 1e
check "frames" wrong frames p.mov atom +stts 8 00000001

# y4m FILE HEADER LUMA PIXEL: a frame of flat 8-bit luma, whose first pixel is another.
y4m()
{
    python3 - "$@" <<'END'
import sys
name, header, luma, pixel = sys.argv[1:]
frame = bytearray([int(luma)] * (720 * 576) + [128] * (720 * 576))
frame[0] = int(pixel)
open(name, "wb").write(f"YUV4MPEG2 W720 H576 {header} C422\n".encode() + (b"FRAME\n" + frame) * 2)
END
}
y4m levels.y4m "F25:1 It A12:11" 250 250
check "levels" only levels levels.y4m
y4m reserved.y4m "F25:1 It A12:11" 100 255
check "reserved" only reserved reserved.y4m
y4m raster.y4m "F24:1 I? A12:11" 100 100
check "raster" only raster raster.y4m
y4m still.y4m "F25:1 It A12:11" 100 100
check "a still has no order" right still.y4m
check "which is said" eval "prints 'open   order'"

# ---- The command ----

check "the profiles" exits 0 weft verify --profiles
check "are listed" prints xdcamhd422-1080i50
check "nothing to verify" exits 2 weft verify
check "an unknown profile" exits 2 weft verify a.mov --profile v210-526
check "is guessed" says "did you mean v210-525"
check "an unknown raster" exits 2 weft verify a.mov --raster 526i
check "no such file" only reading none.mov
check "one of two is wrong" exits 1 weft verify a.mov flags.y4m --raster 625i
finish
