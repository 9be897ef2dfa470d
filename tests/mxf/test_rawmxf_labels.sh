#!/bin/bash
# Uncompressed MXF: what it says of colors and timecode, seeking in it, whole files or none, and what is refused.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "test_mxf.c and test_jobs.sh write them"
needs python3
. "$WEFT_SOURCE/tests/mxf/rawmxf.sh"

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
    ! "$python3" "$WEFT_SOURCE/tests/mxf/mxf_check.py" damaged.mxf >out 2>said
}
for part in index footer reference primer; do check "damage to the $part is seen" damaged $part; done

finish
