#!/bin/bash
# weft verify: files that are right, by weft and by others; and for every check a file that fails it and no
# other.
. "$WEFT_SOURCE/tests/script.sh"

ls "$WEFT_BUILD"/lib*/weft/weft-libav.so >/dev/null 2>&1 || { echo "skipped: weft was built without libav"; exit 77; }
has ffmpeg || exit 77
"$WEFT_BUILD/make_subframes" in 32 || exit 1

made()
{
    local output=$1
    shift
    exits 0 weft convert in --subframe-rate 400 --aperture box --temporal-width 0 -q -o "$output" "$@"
}
ffmpeg_made() { ffmpeg -nostdin -v error -y "$@"; }

# right FILE [OPTION..]: nothing is wrong with it.
right() { exits 0 weft verify "$@"; }

# only CHECK FILE [OPTION..]: it is wrong, this is why, and what demands it is said.
only()
{
    local name=$1
    shift
    exits 1 weft verify --json "$@" || return 1
    python3 - "$name" <<'END'
import json, sys
found = json.load(open("out"))[0]
wrong = [c for c in found["checks"] if c["verdict"] == "wrong"]
if [c["check"] for c in wrong] != [sys.argv[1]] or found["right"] or not wrong[0]["should"] or not wrong[0]["by"]:
    sys.exit(f"not {sys.argv[1]} alone: {wrong}")
END
}

# patched FROM TO KIND NAME OFFSET BYTES
patched() { python3 "$WEFT_SOURCE/tests/patch_delivery.py" "$@"; }

# wrong CHECK FROM KIND NAME OFFSET BYTES [OPTION..]: with bytes written over it fails this check alone.
wrong()
{
    local name=$1 from=$2 to=patched.${2##*.}
    patched "$from" "$to" "$3" "$4" "$5" "$6" || return 1
    shift 6
    only "$name" "$to" "$@"
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
ffmpeg_made -i p.mov -map 0:v -c copy -timecode 10:00:00:00 p.mkv
check "container" only container p.mkv --profile prores-1080i50
check "prores of 525" made p5.mov --codec prores --raster 525i --timecode "01:00:00;00"
check "codec" only codec p5.mov --profile v210-525
check "raster" only raster f.mkv --profile no-such || :
check "size" only size y.y4m --raster 720x574@25i,tff,par=12:11,601-625
check "rate" only rate y.y4m --raster 720x576@30i,tff,par=12:11,601-625
sed '1s/ It / Ib /' y.y4m >order.y4m
check "flags" only flags order.y4m --raster 625i
check "order" only order order.y4m --raster 625i-dv
check "aspect" only aspect a.mov --raster 525i-wide
check "colors" wrong colors a.mov atom colr 4 000100010001
check "fiel" wrong fiel a.mov atom fiel 0 0209 --raster 525i
check "atoms" wrong atoms p.mov atom pasp -4 66726565
check "clap" wrong clap a.mov atom clap 0 000002d0
check "pattern" wrong pattern i.mxf label - 13 02
check "layout" wrong layout i.mxf item 320c 0 04
check "line map" wrong "line map" i.mxf item 320d 8 0000001500000100
check "dominance" wrong dominance i.mxf item 3212 0 02
check "siting" wrong siting i.mxf item 3303 0 03
check "aspect of MXF" wrong aspect i.mxf item 320e 0 0000001000000009
check "base" wrong base i.mxf item 1502 0 0019
check "base of QuickTime" wrong base p.mov atom tmcd 24 1e
check "start" only start x.mxf --profile as11-uk-dpp-hd || :
finish
