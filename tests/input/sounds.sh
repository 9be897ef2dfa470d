# shellcheck shell=bash disable=SC2034
# Sound to convert and pictures to put it beside. Sourced after tests/program/script.sh.

sound() { python3 "$WEFT_SOURCE/tests/input/sound.py" "$@"; }
makes() { exits 0 weft convert "$@" --overwrite -q; }
tells() { exits 0 weft convert "${@:2}" --overwrite && says "$1"; }
video() { ffmpeg -nostdin -v error -y -f lavfi -i "testsrc2=s=64x48:r=$1:d=$2" "${@:3}"; }
raster25="--raster 64x48@25p" raster29="--raster 64x48@29.97p"

for bits in 16 24 32; do sound wav n$bits.wav 48000 $bits 2 60000; done
sound wav mono.wav 48000 24 1 60000
video 25 1 -c:v ffv1 p25.mkv
video 30000/1001 1.001 -c:v ffv1 p29.mkv
