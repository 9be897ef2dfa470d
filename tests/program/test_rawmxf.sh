#!/bin/bash
# Uncompressed MXF: rasters of every order and both depths walked by a reader of our own (mxf_check.py), and
# read by ffmpeg and MediaInfo, bit for bit what the raw outputs of the same run are.
. "$WEFT_SOURCE/tests/program/script.sh"

has python3 || exit 77
python3=$(python3 -c "import sys; print(sys.executable)") # not by way of what picks a version
"$WEFT_BUILD/make_subframes" in 16 || exit 1

# write FILE RASTER OPTION..: two or four frames.
write()
{
    local file=$1 raster=$2 rate=160
    shift 2
    case $raster in *psf*|*p[2-6]*|*p) rate=96 ;; esac
    weft convert in/subframe.####.exr -q --subframe-rate $rate --raster "$raster" --overwrite \
        --temporal-width 1 "$@" -o "$file"
}

# make RASTER CODEC OPTION..: out.mxf, and its frames as they are in out.raw.
make()
{
    local raster=$1 codec=$2
    shift 2
    write "out.$codec" "$raster" && mv "out.$codec" out.raw && write out.mxf "$raster" --codec "$codec" "$@"
}

# walked EXPRESSION FILE: out.mxf is well formed, this is true of it, and its pictures are FILE's.
walked() { "$python3" "$WEFT_SOURCE/tests/program/mxf_check.py" out.mxf "$@" >out 2>said || { tail -n 1 said; cat out; return 1; }; }

# probe KEYS VALUES: what ffprobe says of the picture.
probe()
{
    local got
    got=$(ffprobe -v error -select_streams v -show_entries "$1" -of csv=p=0 out.mxf)
    [ "$got" = "$2" ] || { echo "$1 is $got, not $2"; return 1; }
}

# info TEMPLATE VALUES: what MediaInfo says.
info()
{
    local got
    got=$(mediainfo --Inform="$1" out.mxf)
    [ "$got" = "$2" ] || { echo "$1 is $got, not $2"; return 1; }
}

# Bit for bit, by copying packets and by decoding them, without a word.
read_back()
{
    ffmpeg -nostdin -v error -xerror -i out.mxf -map 0:v -c copy -f data -y copied \
        -map 0 -f null - 2>said && cmp copied out.raw && [ ! -s said ] || { cat said; return 1; }
}

# ---- Rasters ----

# Raster, size, what ffprobe calls the order, what MediaInfo does, stored lines, layout, standard,
# last bytes of the essence container's label (ST 384), line map, aspect, timecode base, codec.
rasters='525i 720,486 bb Interlaced/BFF 243 1 1 0101 [21,283] 4/3 30 uyvy
525i-imx 720,486 tt Interlaced/TFF 243 1 1 0101 [20,283] 4/3 30 v210
525i-rp202-wide 720,480 tt Interlaced/TFF 240 1 1 0101 [23,286] 16/9 30 uyvy
625i 720,576 tt Interlaced/TFF 288 1 1 0105 [23,336] 4/3 25 v210
625i-dv 720,576 bb Interlaced/BFF 288 1 1 0105 [23,335] 4/3 25 uyvy
1080i50 1920,1080 tt Interlaced/TFF 540 1 4 0229 [21,584] 16/9 25 v210
1080psf24 1920,1080 progressive Progressive/ 1080 0 4 7f01 [42,0] 16/9 24 uyvy
720p50 1280,720 progressive Progressive/ 720 0 5 0319 [26,0] 16/9 50 v210
46x14@30i,tff 46,14 tt Interlaced/TFF 7 1 0 7f01 [1,10] 23/7 30 uyvy
46x14@30i,bff 46,14 bb Interlaced/BFF 7 1 0 7f01 [1,9] 23/7 30 v210
50x7@24p 50,7 progressive Progressive/ 7 0 0 7f01 [1,0] 50/7 24 v210'
[ -z "${WEFT_SANITIZE:-}" ] || rasters=$(sed -n '1p;6p;10,11p' <<<"$rasters")

while read -r name size order scan stored layout standard label map aspect base codec; do
    bits=10 levels='[64, 940, 897]' coding=060e2b340401010a0401020101020201 decoder=v210
    [ "$codec" = uyvy ] &&
        bits=8 levels='[16, 235, 225]' coding=060e2b340401010a0401020101020101 decoder=rawvideo
    what="$name, $codec"
    check "$what" make "$name" "$codec"
    check "$what: walked" walked "d['stored_height'] == d['sampled_height'] == \
d['display_height'] == $stored and d['stored_width'] == d['sampled_width'] == d['display_width'] \
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

# ---- Standards and colors ----

# Space of the codes, raster; ends of the labels of primaries, transfer and equations; ffprobe's words.
colors='rec601-525 48x6@30i,bff,601-525 0301 0102 0201 bt470bg,bt709,smpte170m
rec601-625 48x6@25i,tff,601-625 0302 0102 0201 bt470bg,bt709,bt470bg
rec709 48x6@25p 0303 0102 0202 bt709,bt709,bt709
rec2020 48x6@25p,2020 0304 0109 0206 bt2020nc,bt2020-10,bt2020
rec2100-pq 48x6@25p,2020 0304 010a 0206 bt2020nc,smpte2084,bt2020
rec2100-hlg 48x6@25p,2020 0304 010b 0206 bt2020nc,arib-std-b67,bt2020'
while read -r space raster primaries transfer equations words; do
    check "$space" write out.mxf "$raster" --codec v210 --to "$space"
    check "$space: labels" walked "[d[k][24:28] for k in ('primaries', 'transfer', 'equations')] \
== ['$primaries', '$transfer', '$equations']"
    if has ffprobe; then
        check "$space: ffprobe" probe stream=color_range,color_space,color_transfer,color_primaries \
            "tv,$words"
    fi
done <<<"$colors"
check "full range" write out.mxf 48x6@25p --codec v210 --range full
check "full range: levels" walked "[d['black'], d['white'], d['range']] == [0, 1023, 1024]"
if has ffprobe; then check "full range: ffprobe" probe stream=color_range pc; fi

# ---- Timecode ----

# Label, raster, frames since midnight.
while read -r label raster start; do
    check "$label" write out.mxf "$raster" --codec uyvy --timecode "$label"
    check "$label: walked" walked "d['start'] == $start and d['drop'] == ('$label'[8] == ';')"
    if has ffprobe; then check "$label: ffprobe" probe format_tags=timecode "$label"; fi
    if has mediainfo; then
        check "$label: MediaInfo" grep -q "^$label" <(mediainfo --Inform='Other;%TimeCode_FirstFrame%\n' out.mxf)
    fi
done <<<'01:00:00:05 48x6@29.97p 108005
01:00:00;05 48x6@29.97p 107897
10:00:00:00 48x6@25i,tff 900000
00:01:00;04 48x6@59.94p 3600'

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

# ---- Seeking ----

# Frame n of the file, sought by its time, is frame n of the raw file.
sought()
{
    ffmpeg -nostdin -v error -xerror -ss "$("$python3" -c "print(($1 - .3) / 24)")" -i out.mxf -frames:v 1 \
        -f rawvideo -y frame && tail -c +$((1 + $1 * $2)) out.raw | head -c "$2" | cmp - frame
}
make 360x240@24p uyvy --audio silent:2
if has ffmpeg; then
    for n in 1 2 3; do check "seeking frame $n" sought $n $((2 * 360 * 240)); done
fi

# ---- Equal bytes, whole files ----

mv out.mxf first.mxf
make 360x240@24p uyvy --audio silent:2
check "the same run gives the same bytes" cmp first.mxf out.mxf
mkdir left
check "a file that may not grow" exits 1 bash -c "ulimit -f 300; '$WEFT' convert in/subframe.####.exr \
    --subframe-rate 96 --raster 360x240@24p --temporal-width 1 --codec uyvy -o left/out.mxf"
check "nothing is left of it" [ -z "$(ls -A left)" ]
check "4:4:4 is refused" exits 2 "$WEFT" convert in/subframe.####.exr --chroma 444 --codec v210 -o left/out.mxf
check "12 bits are refused" exits 2 "$WEFT" convert in/subframe.####.exr --bits 12 --codec v210 -o left/out.mxf

# The walker itself: a byte of the index, of a partition, of a reference, of the primer is seen.
damaged()
{
    "$python3" - "$1" <<'END'
import sys
d = bytearray(open("first.mxf", "rb").read())
where = {"index": d.rfind(bytes.fromhex("3f050004")) + 7, "footer": len(d) - 12,
         "reference": d.find(bytes.fromhex("48030010")) + 19,
         "primer": d.find(bytes.fromhex("0d01020101050100")) + 21}[sys.argv[1]]
d[where] ^= 1
open("damaged.mxf", "wb").write(d)
END
    ! "$python3" "$WEFT_SOURCE/tests/program/mxf_check.py" damaged.mxf >out 2>said
}
for part in index footer reference primer; do check "damage to the $part is seen" damaged $part; done

finish
