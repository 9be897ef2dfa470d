#!/bin/bash
# Sound of files and places in them, and tones; what is said of it, what is refused, and damage.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "test_jobs.sh and the fuzz target do"
needs_libav
needs ffmpeg ffprobe python3

. "$WEFT_SOURCE/tests/input/sounds.sh"

# ---- A file's ----

check "a file" makes p25.mkv $raster25 --audio n24.wav -o o.mov
check "from its beginning" sound tracks o.mov n24.wav 0 48000 24
check "from a place" makes p25.mkv $raster25 --audio n24.wav:0.125 -o o.mov
check "in it" sound tracks o.mov n24.wav 6000 48000 24
check "with silence before" tells "goes on for 0.750 s" p25.mkv $raster25 --audio n24.wav:-0.5 -o o.mov
check "it" sound tracks o.mov n24.wav -24000 48000 24
check "a clock" makes p25.mkv $raster25 --audio n24.wav:00:00:00.25 -o o.mov
check "time" sound tracks o.mov n24.wav 12000 48000 24
check "a timecode" makes p25.mkv $raster25 --audio n24.wav:00:00:00:05 -o o.mov
check "of frames" sound tracks o.mov n24.wav 9600 48000 24
check "frames of a file" makes p29.mkv $raster29 --audio n24.wav:0.125 --output-frames 4-8 -o o.mov
check "begin there" sound tracks o.mov n24.wav $((6000 + 6406)) 8008 24
cp n24.wav take:2
cp n24.wav take:2.wav
check "names with a colon" makes p25.mkv $raster25 --audio ./take:2 -o o.mov
check "are names" makes p25.mkv $raster25 --audio take:2.wav -o o.mov
check "32 bits in 24" tells "rounded to 24" p25.mkv $raster25 --audio n32.wav -o o.mov
check "are rounded" sound tracks o.mov n32.wav 0 48000 24
check "shorter sound" tells "ends 0.375 s before the pictures" p25.mkv $raster25 --audio n24.wav:0.625 -o o.mkv
check "ends in silence" sound tracks o.mkv n24.wav 30000 48000 24
check "longer sound" tells "goes on for 0.250 s" p25.mkv $raster25 --audio n24.wav -o o.mkv
check "mono in eight tracks" tells "from 2 on are silent" p25.mkv $raster25 --audio mono.wav --audio-tracks 8 -o o.mov
check "is in the first" sound tracks o.mov mono.wav 0 48000 24 8
check "mono in D-10" tells "4 tracks of sound those from 2" p25.mkv --raster 625i --codec imx50 --audio mono.wav \
    --output-frames 0-3 -o o.mxf
check "is one of four" sound tracks o.mxf mono.wav 0 7680 24 4
ffmpeg -nostdin -v error -f lavfi -i "aevalsrc=0.5*sin(2*PI*3000*t):s=44100:d=1.1" -c:a pcm_f32le cd.wav
ffmpeg -nostdin -v error -f lavfi -i "aevalsrc=0.5*sin(2*PI*3000*t):s=96000:d=1.1" -c:a pcm_s24le hi.wav
ffmpeg -nostdin -v error -i n24.wav -c:a pcm_s24le n24.w64
ffmpeg -nostdin -v error -i n24.wav -c:a pcm_s24le -rf64 always n24rf.wav
ffmpeg -nostdin -v error -i n24.wav -c:a flac n24.flac
for name in n24.w64 n24rf.wav n24.flac; do
    check "$name" makes p25.mkv $raster25 --audio $name -o o.mov
    check "has the same samples" sound tracks o.mov n24.wav 0 48000 24
done
for name in cd.wav hi.wav; do
    check "$name" tells "resampled to 48000 Hz" p25.mkv $raster25 --audio $name -o o.mov
    check "is the same sine" sound sine o.mov 3000
done

# ---- Tones ----

check "a tone" makes p29.mkv $raster29 --audio tone:2 --audio-tracks 2 -o o.mov
check "of -18 dBFS" sound tone o.mov 2 24 48048 0
check "goes on" makes p29.mkv $raster29 --audio tone:2 --output-frames 7-16 -o o.mkv
check "through parts" sound tone o.mkv 2 24 16016 11211
check "of a render" exits 0 weft render "$WEFT_SOURCE/examples/scenes/carousel.lua" --raster 64x48@25p --samples 1 -q \
    --frames 0-4 --audio tone:8 -o tone.mov
check "too" sound tone tone.mov 8 24 9600 0

# ---- What is refused ----

subframes in 8
ffmpeg -nostdin -v error -i p25.mkv -i n24.wav -map 0:v -map 1:a -c:v ffv1 -c:a pcm_s24le -t 1 many.mkv
no() { exits "$1" weft convert "${@:3}" -o no.mov && says "$2" && [ ! -e no.mov ]; }
check "no sound to copy" no 2 "give --audio FILE.wav, or silent:2" p25.mkv $raster25 --audio copy
check "pictures" no 2 "has no sound; give --audio FILE.wav" in --subframe-rate 400 --audio copy
check "a scene" exits 2 weft render "$WEFT_SOURCE/examples/scenes/carousel.lua" --audio copy -o no.mov
check "has none" says "a scene has no sound"
check "a pipe" no 2 "a pipe is read once" <(cat many.mkv) $raster25 --audio copy
check "ten times the speed" no 2 "too much for its sound" many.mkv $raster25 --subframe-rate 250 --audio copy
for output in no.y4m no.####.png no.####.dpx no.####.exr no.v210; do
    check "$output" exits 2 weft convert p25.mkv $raster25 --audio tone:2 -o $output
    check "holds no sound" says "--audio is for .mov, .mxf and .mkv"
done
check "no such file" no 1 "none.wav: it cannot be opened: No such file" p25.mkv $raster25 --audio none.wav
check "no sound" no 2 "p29.mkv: it holds no sound" p25.mkv $raster25 --audio p29.mkv
check "a directory" no 2 "is no file" p25.mkv $raster25 --audio ./
check "words" no 2 "did you mean copy" p25.mkv $raster25 --audio cpoy
check "17 tracks" no 2 "from 1 to 16" p25.mkv $raster25 --audio tone:17
check "a place after its end" no 2 "is 1.250 s long" p25.mkv $raster25 --audio n24.wav:2
check "a frame that there is not" no 2 "no timecode 00:00:00:29" p25.mkv $raster25 --audio n24.wav:00:00:00:29
check "32 bits of MXF" exits 2 weft convert p25.mkv --raster 625i --codec v210 --audio tone:2 --audio-bits 32 -o no.mxf
check "are told" says "--audio-bits 16 or 24, not 32"
check "an input" exits 2 weft convert p25.mkv $raster25 --audio many.mkv --overwrite -o many.mkv
check "is not replaced" says "would replace an input"

# ---- Damage ----

sound wav claims.wav 48000 24 2 20000 60000
check "a file that is cut off" no 1 "claims.wav: its sound is damaged or cut off at 0.4" p25.mkv $raster25 --audio claims.wav
head -c 30 n24.wav >head.wav
check "half a header" no 1 "head.wav" p25.mkv $raster25 --audio head.wav
head -c 5000 /dev/urandom >noise.wav
check "no sound at all" no 1 "noise.wav" p25.mkv $raster25 --audio noise.wav
: >empty.wav
check "nothing" no 1 "empty.wav" p25.mkv $raster25 --audio empty.wav
python3 - <<'P'
data = bytearray(open("n24.flac", "rb").read())
data[len(data) // 2:len(data) // 2 + 3000] = bytes(3000)
open("bad.flac", "wb").write(data)
P
check "damage in the middle" no 1 "bad.flac: its sound" p25.mkv $raster25 --audio bad.flac
finish
