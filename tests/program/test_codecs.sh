#!/bin/bash
# Every codec on the rasters it takes, in QuickTime, MXF and Matroska: held by other programs and byte
# by byte to what the raster demands, and known again by weft.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "test_jobs.sh writes containers"
needs_libav
needs ffmpeg ffprobe mediainfo
subframes in 64

# delivered FILE CODEC RASTER [TIMECODE [TRACKS]]: it says and holds what its raster demands.
delivered() { python3 "$WEFT_SOURCE/tests/program/delivered.py" "$@"; }

# ---- Every codec, the rasters it takes ----

# FILE CODEC RASTER [OPTION..]
cat >matrix <<'END'
525i.mov v210 525i
prores.mov prores 525i
xdcam.mov xdcamhd422 1080i59.94
dv.mov dvcpro50 525i
avci720.mov avci100 720p50
imx525.mxf imx50 525i-imx
dv.mxf dvcpro50 625i-dv
dnxhd.mxf dnxhd 1080psf25
525i.mkv ffv1 525i
END
is_sanitized || cat >>matrix <<'END'
wide.mov v210 625i-dv-wide
hq.mov prores-hq 525i-imx
4444.mov prores-4444 625i
dnxhd.mov dnxhd 1080i50
dnxhd8.mov dnxhd 720p50 --bits 8
dnxhr.mov dnxhr 1080p23.976
xdcam720.mov xdcamhd422 720p59.94
dv625.mov dvcpro50 625i-dv-wide
avci.mov avci100 1080i59.94
avci24.mov avci100 1080p23.976
xdcam.mxf xdcamhd422 1080i50
xdcam24.mxf xdcamhd422 1080p23.976
xdcam720.mxf xdcamhd422 720p50
dnxhdi.mxf dnxhd 1080i59.94
imx.mxf imx50 625i-wide
dv525.mxf dvcpro50 525i-imx
avci.mxf avci100 1080i59.94
rp202.mkv ffv1 525i-rp202
444.mkv ffv1 625i-dv --bits 16 --chroma 444
END
make_one()
{
    local file=$1 codec=$2 raster=$3
    shift 3
    [ "$codec" != avci100 ] || [ -n "$have_x264" ] || return 0
    timeout 250 "$WEFT" convert in --subframe-rate 400 --aperture box --temporal-width 0 --threads 1 -q -o "$file" \
        --codec "$codec" --raster "$raster" "$@" >"$file.said" 2>&1 && delivered "$file" "$codec" "$raster" >>"$file.said" 2>&1 && "$WEFT" verify "$file" >>"$file.said" 2>&1
    echo $? >"$file.rc"
}
export -f make_one delivered
have_x264=$(ffmpeg -hide_banner -encoders 2>/dev/null | grep -o libx264 | head -n 1)
export have_x264 WEFT WEFT_SOURCE
[ -n "$have_x264" ] || skip_part "AVC-Intra, as there is no libx264"
xargs -P 2 -L 1 bash -c 'make_one "$@"' _ <matrix
right() { [ "$(cat "$1.rc" 2>/dev/null)" = 0 ] || { cat "$1.said"; return 1; }; }
while read -r file codec raster _; do
    [ "$codec" = avci100 ] && [ -z "$have_x264" ] && continue
    check "$codec of $raster in $file" right "$file"
done <matrix

# ---- Read back ----

# known FILE RASTER: what weft makes of it.
known() { exits 0 weft info "$1" --json && value "d['files'][0]['raster'] == '$2'"; }
check "raster of v210" known 525i.mov 525i
check "of DV, in the order of its own" known dv.mov 525i-dv
check "of DV in MXF" known dv.mxf 625i-dv
check "of D-10, without the interval's lines" known imx525.mxf 525i-imx
check "of XDCAM" known xdcam.mov 1080i59.94
check "of FFV1" known 525i.mkv 525i

# ---- The same again ----

# again FILE CODEC RASTER
again() { made "again-$1" --codec "$2" --raster "$3" --threads 2 && cmp "again-$1" "$1"; }
check "v210 is the same for any number of threads" again 525i.mov v210 525i
check "so is ProRes" again prores.mov prores 525i
check "so is DV" again dv.mov dvcpro50 525i
check "so is D-10" again imx525.mxf imx50 525i-imx
check "so is FFV1" again 525i.mkv ffv1 525i
check "so is XDCAM" again xdcam.mov xdcamhd422 1080i59.94
check "so is DNxHD" again dnxhd.mxf dnxhd 1080psf25
[ -z "$have_x264" ] || check "so is AVC-Intra" again avci720.mov avci100 720p50

finish
