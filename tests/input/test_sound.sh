#!/bin/bash
# Sound of the input video: its samples bit for bit, of all streams, from where the pictures begin.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "test_jobs.sh and the fuzz target do"
needs_libav
needs ffmpeg ffprobe python3

. "$WEFT_SOURCE/tests/input/sounds.sh"

# ---- The input's, bit for bit ----

for ending in mov mkv; do
    for bits in 16 24 32; do
        for rate in 25 29; do
            ffmpeg -nostdin -v error -y -i p$rate.mkv -i n$bits.wav -map 0:v -map 1:a -c:v ffv1 -c:a copy -t 1 -strict -2 \
                -y i.$ending
            raster=raster$rate count=48000 all=25
            [ $rate = 29 ] && count=48048 all=30
            check "$bits bits at $rate in .$ending" makes i.$ending ${!raster} --audio copy --audio-bits $bits -o o.mov
            check "is what went in" sound tracks o.mov n$bits.wav 0 $count $bits
            check "its frames from 7 on" makes i.$ending ${!raster} --output-frames 7-16 --audio copy --audio-bits $bits -o o.mov
            case $rate in 25) at=13440 count=19200 ;; 29) at=11211 count=16016 ;; esac
            check "as well" sound tracks o.mov n$bits.wav $at $count $bits
            check "its pictures from 8 on" makes i.$ending ${!raster} --frames 8-$((all - 1)) --audio copy --audio-bits $bits \
                --output-frames 0-4 -o o.mkv
            case $rate in 25) at=15360 count=9600 ;; 29) at=12813 count=8008 ;; esac
            check "too" sound tracks o.mkv n$bits.wav $at $count $bits
        done
    done
done
ffmpeg -nostdin -v error -y -i p25.mkv -i n24.wav -i mono.wav -i n16.wav -map 0:v -map 1:a -map 2:a -map 3:a -c:v ffv1 \
    -c:a:0 pcm_s24le -c:a:1 pcm_s24le -c:a:2 pcm_s16le -t 1 many.mov
ffmpeg -nostdin -v error -i many.mov -map 0 -c copy many.mkv
check "streams" makes many.mov $raster25 --audio copy --report r.json -o o.mxf --codec uyvy
check "one after the other" sound probe o.mxf 5 1 24 1
check "are told" grep -q "copy: 5 channels (pcm_s24le, 48000 Hz, 3 streams); 5 tracks of 24 bits" r.json
check "by info" exits 0 weft info many.mov
check "as well" prints "5 channels (pcm_s24le, 48000 Hz, 3 streams)"
check "or that there is none" exits 0 weft info p25.mkv --json
check "in words" value "d['files'][0]['sound'] == 'none'"
check "in a dry run" exits 0 weft convert many.mov $raster25 --audio copy --dry-run -o new.mov
check "too" prints "input audio: copy: 5 channels"
check "some of them" tells "from 4 on are left out" many.mov $raster25 --audio copy --audio-tracks 3 -o o.mov
check "are the first" sound probe o.mov 3 1 24 1
ffmpeg -nostdin -v error -y -i p25.mkv -itsoffset 0.5 -i n24.wav -map 0:v -map 1:a -c:v ffv1 -c:a pcm_s24le -t 1 late.mov
check "sound that begins later" makes late.mov $raster25 --audio copy -o o.mov
check "does so in the output" sound tracks o.mov n24.wav -24000 48000 24


# ---- Time ----

ffmpeg -nostdin -v error -i p25.mkv -i n16.wav -map 0:v -map 1:a -c:v ffv1 -c:a pcm_s16le \
    -af "aselect='not(between(t,0.25,0.5))'" -t 1 gap.mkv
check "a gap" tells "a gap or an overlap at 0.2" gap.mkv $raster25 --audio copy -o o.mov
check "stays one" sound gap o.mov n16.wav
ffmpeg -nostdin -v error -f lavfi -i testsrc2=s=64x48:r=24:d=1.25 -f lavfi -i "aevalsrc=0.5*sin(2*PI*3000*t):s=48000:d=1.3" \
    -map 0 -map 1 -c:v ffv1 -c:a pcm_s24le film.mkv
check "film that is slowed" tells "0.999001 times its speed" film.mkv --raster 525i --cadence 2:3 --audio copy -o o.mov
check "and its sound" sound sine o.mov 3000/1.001
check "film at 25" tells "1.04167 times its speed" film.mkv $raster25 --subframe-rate 25 --audio copy -o o.mov
check "and its sound" sound sine o.mov 3125
check "and a part" makes film.mkv $raster25 --subframe-rate 25 --audio copy --output-frames 12-23 -o o.mov
check "which begins in time" sound sine o.mov 3125
check "its own rate" makes film.mkv --raster 64x48@24p --subframe-rate 24 --audio copy -o o.mov
check "its own sound" sound sine o.mov 3000
finish
