#!/bin/bash
# Uncompressed MXF: rasters of every order and both depths, and sound, walked by a reader of our own and read by
# ffmpeg and MediaInfo, bit for bit what the raw outputs of the same run are.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "test_mxf.c and test_jobs.sh write them"
needs python3
. "$WEFT_SOURCE/tests/mxf/rawmxf.sh"

# ---- Rasters ----

# Raster, size, what MediaInfo calls the scan, layout, standard, last bytes of the essence container's label (ST 384),
# line map, aspect, timecode base, codec. Of mixed fields ffprobe has no order; MediaInfo has it, and says progressive.
rasters='525i 720,486 Progressive/BFF 3 1 0101 [21,283] 4/3 30 uyvy
525i-imx 720,486 Progressive/TFF 3 1 0101 [20,283] 4/3 30 v210
525i-rp202-wide 720,480 Progressive/TFF 3 1 0101 [23,286] 16/9 30 uyvy
625i 720,576 Progressive/TFF 3 1 0105 [23,336] 4/3 25 v210
625i-dv 720,576 Progressive/BFF 3 1 0105 [23,335] 4/3 25 uyvy
1080i50 1920,1080 Progressive/TFF 3 4 0229 [21,584] 16/9 25 v210
1080psf24 1920,1080 Progressive/ 0 4 7f01 [42,0] 16/9 24 uyvy
720p50 1280,720 Progressive/ 0 5 0319 [26,0] 16/9 50 v210
46x14@30i,tff 46,14 Progressive/TFF 3 0 7f01 [1,10] 23/7 30 uyvy
46x14@30i,bff 46,14 Progressive/BFF 3 0 7f01 [1,9] 23/7 30 v210
50x7@24p 50,7 Progressive/ 0 0 7f01 [1,0] 50/7 24 v210'
is_sanitized && rasters=$(sed -n '1p;6p;10,11p' <<<"$rasters")

while read -r name size scan layout standard label map aspect base codec; do
    bits=10 levels='[64, 940, 897]' coding=060e2b340401010a0401020101020201 decoder=v210
    order=unknown
    [ "$layout" = 0 ] && order=progressive
    [ "$codec" = uyvy ] &&
        bits=8 levels='[16, 235, 225]' coding=060e2b340401010a0401020101020101 decoder=rawvideo
    what="$name, $codec"
    check "$what" make "$name" "$codec"
    check "$what: walked" walked "d['stored_height'] == d['sampled_height'] == \
d['display_height'] == ${size#*,} and d['stored_width'] == d['sampled_width'] == d['display_width'] \
== ${size%,*} and d['layout'] == $layout and d['depth'] == $bits and d.get('standard', 0) == \
$standard and d['container'][-4:] == '$label' and d['map'] == $map and d['aspect'] == '$aspect' \
and d['base'] == $base and d['coding'] == '$coding' and d['frames'] > 1 and [d['across'], \
d['down'], d['siting']] == [2, 1, 0] and [d['black'], d['white'], d['range']] == $levels" out.raw
    if has ffprobe; then
        check "$what: ffprobe" probe stream=codec_name,width,height,field_order \
            "$decoder,$size,$order"
        check "$what: ffmpeg" read_back
    fi
    if has mediainfo; then
        check "$what: MediaInfo" info \
            "Video;%Width%,%Height% %BitDepth% %ScanType%/%ScanOrder% %ChromaSubsampling%" \
            "$size $bits $scan 4:2:2"
    fi
done <<<"$rasters"

# ---- Sound ----

# Raster, tracks, samples of the first frames.
while read -r raster tracks samples; do
    check "$raster with sound" make "$raster" v210 --audio "silent:$tracks"
    check "$raster with sound: walked" walked "d['sound_tracks'] == $tracks and \
d['samples'] == $samples[:d['frames']] and len(d['containers']) == 3 and \
d['containers'][1][-8:] == '02060100'" out.raw
    if has ffprobe; then
        check "$raster with sound: ffmpeg" read_back
        check "$raster with sound: ffprobe" [ "$(ffprobe -v error -select_streams a -show_entries \
            stream=codec_name,sample_rate,channels -of csv=p=0 out.mxf | sort | uniq -c | tr -s ' ')" = \
            " $tracks pcm_s24le,48000,1" ]
        ffmpeg -nostdin -v error -i out.mxf -map 0:a:0 -f s24le -y sound
        check "$raster with sound: it is silent" cmp -s sound <(head -c "$(stat -c %s sound)" /dev/zero)
        check "$raster with sound: all of it" value "$(stat -c %s sound) == 3 * sum(d['samples'])"
    fi
    if has mediainfo; then
        check "$raster with sound: MediaInfo" info 'Audio;%Format% %BitDepth% %SamplingRate% %Channels%|' \
            "$(for ((i = 0; i < tracks; i++)); do printf 'PCM 24 48000 1|'; done)"
    fi
done <<<'48x6@29.97p 2 [1602,1601,1602,1601]
48x6@59.94p 1 [801,801,800,801,801,801,801,800,801]
48x6@25i,tff 4 [1920,1920,1920,1920]
48x6@23.976p 16 [2002,2002,2002,2002]'
check "17 tracks are refused" exits 2 "$WEFT" convert in/subframe.####.exr --codec v210 --audio silent:17 -o no.mxf

finish
