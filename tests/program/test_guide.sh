#!/bin/bash
# The lines of the TD's page "From other programs" run on files that are made as those programs make them.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "the same readers are in tests/input"
needs oiiotool ffmpeg python3
needs_libav

# frames NAME COUNT CHANNELS COLOR OPTION..: COUNT pictures of one color, NAME with a %d field.
frames()
{
    local name=$1 count=$2 channels=$3 color=$4 k
    shift 4
    mkdir -p "$(dirname "$name")"
    oiiotool --pattern "constant:color=$color" 192x108 "$(tr ',' '\n' <<<"$channels" | wc -l)" --chnames "$channels" "$@" -o one."${name##*.}"
    for ((k = 1; k <= count; k++)); do
        # shellcheck disable=SC2059
        cp one."${name##*.}" "$(printf "$name" "$k")"
    done
}

v=ViewLayer
frames blender/shot%04d.exr 16 $v.Combined.R,$v.Combined.G,$v.Combined.B,$v.Combined.A,$v.Depth.Z,$v.Normal.X,$v.Normal.Y,$v.Normal.Z,$v.IndexOB.X \
    .18,.18,.18,1,9,0,0,1,3 -d half
frames unreal/Seq.%04d.exr 16 R,G,B,A .18,.18,.18,1 -d half
frames one%d.exr 1 C.R,C.G,C.B,C.A,N.X,N.Y,N.Z,Pz .18,.18,.18,1,0,0,1,9 -d half
mkdir karma && for k in 1001 1002 1003 1004; do
    cp one1.exr karma/karma.$k.exr
    for f in 25 5 75; do cp one1.exr karma/karma.$k.$f.exr; done
done
frames comp.%04d.exr 16 R,G,B,A .18,.18,.18,1 -d half
frames titles/titles_%05d.png 16 R,G,B,A .2,.2,.2,.5 -d uint16
frames credits_%05d.tif 16 R,G,B .46,.46,.46 -d uint16
ffmpeg -v error -f lavfi -i color=gray:s=192x108:r=240:d=0.2 -f lavfi -i sine=sample_rate=48000:d=0.2 -c:a pcm_s16le -color_primaries bt709 -color_trc bt709 -colorspace bt709 \
    -color_range tv -c:v ffv1 -y capture.mkv
ffmpeg -v error -f lavfi -i color=gray:s=192x108:r=60:d=1 -vf "setpts=N/60/TB+mod(N\,3)/600/TB" -fps_mode vfr \
    -pix_fmt yuv420p -color_primaries bt2020 -color_trc arib-std-b67 -colorspace bt2020nc -color_range tv \
    -c:v libx264 -y phone.mp4 2>/dev/null
shared=${WEFT_SHARED:-}/data/ocio/cg-config-v1.0.0_aces-v1.3_ocio-v2.1.ocio
[ -r "$shared" ] && cp "$shared" studio.ocio

sed -n '/^## From other programs/,/^## /s/^    \(weft .*\)/\1/p' "$WEFT_SOURCE/examples/guides/td.md" >lines
check "there are lines" test "$(wc -l <lines)" -ge 9
while read -r line; do
    case $line in
    */usr/share/blender/*) [ -r /usr/share/blender/datafiles/colormanagement/config.ocio ] || { skip_part "no Blender"; continue; } ;;
    *studio.ocio*) [ -r studio.ocio ] || { skip_part "WEFT_SHARED has no data/ocio"; continue; } ;;
    *phone*) [ -s phone.mp4 ] || { skip_part "ffmpeg has no libx264"; continue; } ;;
    esac
    check "$line" eval "exits 0 $line" </dev/null
    made=${line##* -o }
    check "its output: $line" test -s "${made%% *}"
done <lines

finish
