#!/bin/bash
# make_video.sh FOLDER: what fuzz-libav begins from, tiny video of many kinds, where there is ffmpeg to make it.
mkdir -p "$1" && cd "$1" || exit 1
command -v ffmpeg >/dev/null || exit 0
made() { ffmpeg -nostdin -v error -y -f lavfi -i testsrc2=s=32x16:r=50:d=0.12 -pix_fmt "$2" "${@:3}" "$1" || rm -f "$1"; }
made h264.mp4 yuv420p -c:v libx264 -bf 2 -g 4
made h264.ts yuv420p -c:v libx264
made ffv1.mkv yuv444p10le -c:v ffv1 -level 3 -slicecrc 1
made mpeg2.mxf yuv422p -c:v mpeg2video
made mpeg4.avi yuv420p -c:v mpeg4
made prores.mov yuv422p10le -c:v prores_ks -timecode 01:00:00:00
exit 0
