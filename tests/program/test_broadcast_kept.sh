#!/bin/bash
# weft composite keeps the time code and the sound of its input, in containers and in sequences, unless it is told otherwise.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "test_jobs.sh composites"
needs_libav
needs ffmpeg
subframes in 32

sound() { ffmpeg -nostdin -v error -i "$1" -map 0:a:1 -c:a pcm_s24le -f md5 -; }
label() { ffprobe -v error -show_entries "format_tags=timecode:stream_tags=timecode" -of csv=p=0 "$1" | grep -o '[0-9][0-9:;]*:[0-9:;]*' | head -n 1; }

check "video with both" made in.mov --codec v210 --raster 525i --audio tone:2 --timecode '01:00:59;28'
for out in out.mov out.mkv out.mxf; do
    codec=v210
    [ $out = out.mkv ] && codec=ffv1
    check "$out" exits 0 weft composite in.mov -o $out --codec $codec
    check "$out has the time code" same "$(label $out)" '01:00:59;28'
    check "$out has the sound, sample by sample" same "$(sound $out)" "$(sound in.mov)"
    check "$out: as long as the picture" eval "weft verify $out 2>said | grep -q 'right  sound'"
done
check "DPX" exits 0 weft composite in.mov -o 'd.####.dpx'
check "says that it has no sound" says "DPX has no sound"
check "and has the labels" exits 0 weft verify 'd.####.dpx'
check "one after the other" prints "01:00:59;28, in 2 of 2 files"
check "from which they go on" exits 0 weft composite 'd.####.dpx' -o again.mov
check "into a container" same "$(label again.mov)" '01:00:59;28'

check "another time code" exits 0 weft composite in.mov -o other.mov --timecode 10:00:00:00 --audio none
check "goes before the input's" same "$(label other.mov)" 10:00:00:00
check "and no sound is none" same "$(stream other.mov stream=codec_name | wc -l)$(ffprobe -v error -select_streams a -show_entries stream=codec_name -of csv=p=0 other.mov)" 1
check "silence" exits 0 weft composite in.mov -o silent.mov --audio silent:4
check "has four tracks" same "$(ffprobe -v error -select_streams a -show_entries stream=codec_name -of csv=p=0 silent.mov | wc -l)" 4
check "video without either" made bare.y4m --raster 525i
check "is shown without a word" exits 0 weft composite bare.y4m -o bare.mov
check "of these" [ ! -s said ]
check "sound cannot be asked of Y4M" exits 2 weft composite in.mov -o no.y4m --audio copy

finish
