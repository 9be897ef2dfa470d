#!/bin/bash
# 20,000 mutations of small containers of every kind, each through verify and measure of the build with sanitizers.
# COUNT and SEED are its arguments.
set -eu
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
weft=${WEFT_SANITIZED:-$source_dir/build-sanitize/weft}
[ -x "$weft" ] || { echo "skipped: no $weft; tests/run.sh sanitize builds it"; exit 77; }
command -v ffmpeg >/dev/null || { echo "skipped: no ffmpeg"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
mkdir in seeds
"$(dirname "$weft")/make_subframes" in 96
made()
{
    "$weft" convert in --subframe-rate 400 --aperture box --temporal-width 0 --raster 32x24@25i,tff -q -o "seeds/$1" "${@:2}"
}
made own.mxf --codec v210 --audio silent:2
made v210.mov --codec v210 --audio silent:2
made ffv1.mkv --codec ffv1 --audio silent:2
made y.y4m
others=(-nostdin -v error -y -f lavfi -i testsrc2=s=32x32:r=25:d=0.16 -f lavfi -i sine=r=48000:d=0.16)
ffmpeg "${others[@]}" -c:v mpeg2video -c:a pcm_s16le seeds/mpeg2.mxf
ffmpeg "${others[@]}" -c:v mpeg2video -c:a aac seeds/mpeg2.mp4
ffmpeg "${others[@]}" -c:v mpeg2video -c:a aac -movflags +frag_keyframe+empty_moov seeds/fragments.mp4
ffmpeg "${others[@]}" -c:v mpeg2video -c:a mp2 seeds/mpeg2.ts
ffmpeg "${others[@]}" -c:v mpeg2video -c:a mp2 seeds/mpeg2.mpg
ffmpeg "${others[@]}" -c:v mpeg2video -c:a pcm_s16le seeds/mpeg2.avi
ffmpeg "${others[@]}" -c:v mpeg2video -an seeds/mpeg2.m2v
ffmpeg "${others[@]}" -c:v ffv1 -c:a flac seeds/others.mkv
ffmpeg "${others[@]}" -c:v prores_ks -pix_fmt yuv422p10 -an seeds/prores.mov
python3 "$source_dir/tests/campaign/containers.py" "$weft" seeds "${1:-20000}" "${2:-1}"
