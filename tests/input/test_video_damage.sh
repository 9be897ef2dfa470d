#!/bin/bash
# Video that was cut off, damaged or joined of unlike parts, and files that are no video: what is said, and that nothing
# is left.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "fuzz-y4m and fuzz-libav read damaged video"
needs_libav
needs ffmpeg python3

box="--from rec709 --raster 64x32@25i --aperture box --bits 8 -q --overwrite"
# coded NAME OPTION..: 100 pictures of ffmpeg's test signal, coded.
coded() { quiet_ffmpeg -f lavfi -i testsrc2=s=64x32:r=100:d=1 -pix_fmt yuv420p "${@:2}" "$1"; }

# stops PATTERN FILE [OPTION..]: status 1, the reason, and no output.
stops()
{
    local pattern=$1 file=$2
    shift 2
    fails "$pattern" weft convert "$file" $box "$@" -o no.y4m && [ ! -e no.y4m ] && [ "$(wc -l <said)" = 1 ]
}

# ---- Cut off ----

coded b.mp4 -c:v libx264 -bf 2 -g 20 -movflags +faststart
coded b.mkv -c:v libx264 -bf 2 -g 20
coded b.ts -c:v libx264 -bf 2 -g 20
coded f.mkv -c:v ffv1 -level 3 -slicecrc 1
coded f.avi -c:v ffv1
coded p.mov -c:v prores_ks
coded m.mxf -c:v mpeg2video -r 50
for file in b.mp4 b.mkv b.ts f.mkv f.avi p.mov m.mxf; do
    check "$file" exits 0 weft convert $file $box -o o.y4m
    for tenth in 3 6 9; do
        head -c $(($(stat -c %s $file) * tenth / 10 + 5)) $file >cut.${file##*.}
        check "$tenth tenths of $file" stops "cut.${file##*.}: " cut.${file##*.}
    done
done
coded late.mp4 -vf scale=512x256 -c:v mjpeg -q:v 1
for bytes in 600 200000; do
    head -c $bytes late.mp4 >cut.mp4
    check "$bytes bytes of MP4 whose index is last" stops "cut off or is still being written" cut.mp4
done
check "by a pipe" fails "index.*end.*faststart" weft convert <(cat late.mp4) $box -o no.y4m
head -c $(($(stat -c %s f.mkv) / 2)) f.mkv >cut.mkv
check "it is said" stops "cut off.*([0-9.]* s)" cut.mkv
check "and some is taken" exits 0 weft convert cut.mkv $box --frames 0-39 -o o.y4m
check "by a pipe" fails "before what it says is its end" weft convert <(cat cut.mkv) $box -o no.y4m
head -c $(($(stat -c %s b.ts) / 376 * 188 + 100)) b.ts >cut.ts
check "a pipe within a packet" fails "." weft convert <(cat cut.ts) $box -o no.y4m

# A word of Y4M that nobody knows may stand for any number of bits.
for chroma in 420nonsense 422foo 422p 422p7 422p17 422p10x 444p10alpha mono7 monop8 410; do
    printf 'YUV4MPEG2 W16 H16 F50:1 Ip C%s\nFRAME\n' $chroma >odd.y4m
    head -c 4096 /dev/zero >>odd.y4m
    check "chroma $chroma" fails "its chroma is '$chroma'" weft convert odd.y4m $box -o no.y4m
done

# ---- Damaged ----

# spoilt FROM TO AT: 64 bytes of it become others.
spoilt()
{
    cp "$1" "$2"
    head -c 64 /dev/zero | tr '\0' '\245' | dd of="$2" bs=1 seek="$3" conv=notrunc 2>dd.said
}
for place in 20000 35000 50000; do
    spoilt f.mkv bad.mkv $place
    check "FFV1 with checksums, at $place" stops "about frame [0-9]* ([0-9.]* s)" bad.mkv
    check "by a pipe" fails "about frame [0-9]* ([0-9.]* s)" weft convert <(cat bad.mkv) $box -o no.y4m
done
for place in 20000 20064 20128 20192 20256 20320; do spoilt b.ts bad.ts $place && mv bad.ts b.ts; done
mv b.ts bad.ts
check "H.264" stops "frame [0-9]* ([0-9.]* s)" bad.ts

check "a pipe of MXF, whose last picture has no time" exits 0 weft convert <(cat m.mxf) $box -o o.y4m

# ---- Missing ----

# missing: which pictures the report says are missing.
missing() { python3 -c "import json; print(*json.load(open('r.json'))['input']['missing'])"; }
# lacking HOW LIST FILE [OPTION..]: status 3, and those pictures are missing.
lacking()
{
    local how=$1 list=$2 file=$3
    shift 3
    exits 3 weft convert "$file" ${box/-q/} "$@" --on-missing $how --report r.json -o o.y4m || return 1
    [ "$(missing)" = "$list" ] || { echo "missing: $(missing)"; return 1; }
}
# replaced FIRST LAST: held.y4m, in which these pictures of s.mkv are the one before them.
replaced()
{
    quiet_ffmpeg -i s.mkv s.y4m && python3 - "$@" <<'END'
import sys
data, (first, last) = open("s.y4m", "rb").read(), map(int, sys.argv[1:])
begin = data.index(b"FRAME")
each = (len(data) - begin) // 100
frames = [data[begin + i * each:begin + (i + 1) * each] for i in range(100)]
frames[first:last + 1] = [frames[first - 1]] * (last + 1 - first)
open("held.y4m", "wb").write(data[:begin] + b"".join(frames))
END
}
all="--raster 64x32@100p" # every picture is needed
coded s.mkv -c:v ffv1 -level 3 -slicecrc 1 -g 1 -pix_fmt yuv444p
spoilt s.mkv bad.mkv 200000
exits 3 weft convert bad.mkv ${box/-q/} $all --on-missing hold --report r.json -o o.y4m
lost=$(missing)
check "one picture is lost" eval '[[ $lost =~ ^[0-9]+$ ]]'
check "it is said why" says "about frame $lost ("
check "and what is there" says "1 picture is missing, the first is $lost: their neighbors are held"
check "the one before" replaced $lost $lost
check "is shown" exits 0 weft convert held.y4m $box $all -o o2.y4m
check "in its place" cmp o.y4m o2.y4m
check "in chunks too" eval 'for c in 1 2 3; do "$WEFT" convert bad.mkv $box $all --on-missing hold --chunk $c/3 -o c$c.y4m; done; cat c?.y4m | cmp - o.y4m'
check "black" lacking black $lost bad.mkv $all
check "is black" eval 'python3 -c "
data = open(\"o.y4m\", \"rb\").read(); begin = data.index(b\"FRAME\"); each = (len(data) - begin) // 100
frame = data[begin + $lost * each + 6:begin + ($lost + 1) * each]
assert set(frame[:64 * 32]) == {16} and set(frame[64 * 32:]) == {128}"'
check "a pipe has the same" lacking hold $lost <(cat bad.mkv) $all
check "cut" cmp o.y4m o2.y4m
spoilt s.mkv bad.mkv 2000
check "the first" lacking hold 0 bad.mkv $all
check "is the one after it" python3 -c 'd = open("o.y4m", "rb").read().split(b"FRAME\n"); assert d[1] == d[2]'
check "what is needed alone is counted" exits 0 weft convert bad.mkv $box --frames 1-99 --on-missing hold -o o.y4m
spoilt b.mp4 bad.mp4 5000
check "H.264" exits 3 weft convert bad.mp4 $box $all --on-missing hold --report r.json -o o.y4m
# Pictures that look at what was lost are lost with it, and all that are left are right.
check "and what is left is right" eval 'lost=" $(missing) " && [ "$(missing | wc -w)" -gt 2 ] && weft convert b.mp4 $box $all -o o2.y4m && python3 -c "
import sys
bad, good = (open(n, \"rb\").read().split(b\"FRAME\n\") for n in (\"o.y4m\", \"o2.y4m\"))
lost = {int(n) + 1 for n in sys.argv[1].split()}
assert len(bad) == len(good) == 101 and all(bad[n] == good[n] for n in range(101) if n not in lost)" "$lost"'
head -c $(($(stat -c %s f.mkv) / 2)) f.mkv >cut.mkv
check "cut off" exits 3 weft convert cut.mkv ${box/-q/} --on-missing hold -o o.y4m
check "it is as long as it says" says "says that it has 100"
check "that is" [ "$(stat -c %s o.y4m)" = "$(weft convert f.mkv $box -o o2.y4m && stat -c %s o2.y4m)" ]
# Wherever it is cut, among pictures that change places as well, what is there keeps its place.
whole=o2.y4m
for file in b.mp4 b.mkv; do
    check "$file whole" exits 0 weft convert $file $box $all --on-missing hold -o $whole
    for tenth in 45 62 83; do
        head -c $(($(stat -c %s $file) * tenth / 100)) $file >cut.${file#*.}
        check "$tenth % of $file" exits 3 weft convert cut.${file#*.} $box $all --on-missing hold --report r.json -o o.y4m
        check "is in its place" python3 -c '
import json
bad, good = (open(n, "rb").read().split(b"FRAME\n") for n in ("o.y4m", "o2.y4m"))
lost = {n + 1 for n in json.load(open("r.json"))["input"]["missing"]}
assert len(bad) == len(good) == 101 and all(bad[n] == good[n] for n in range(101) if n not in lost)'
    done
done
quiet_ffmpeg -i b.mkv -vf "select='not(between(n,40,49))'" -fps_mode vfr -c:v libx264 fewer.mkv
check "pictures that were left out on purpose are not missing" exits 0 weft convert fewer.mkv $box --on-missing hold -o o.y4m
check "cut off by a pipe it is as long as it is" exits 3 weft convert <(cat cut.mkv) $box --on-missing hold -o o.y4m
check "cut Y4M" eval 'head -c $(($(stat -c %s held.y4m) - 100)) held.y4m >cut.y4m; lacking hold 99 cut.y4m $all'
check "by a pipe" exits 3 weft convert - $box --on-missing hold -o o.y4m <cut.y4m
check "a line that is not FRAME" eval 'spoilt held.y4m bad.y4m $(($(grep -abo FRAME held.y4m | sed -n 51p | cut -d: -f1) - 10)); lacking hold 50 bad.y4m $all'
# Frames whose lines have parameters were not cut off by being longer; "some": from the second on.
python3 - <<'END'
data = open("held.y4m", "rb").read()
begin = data.index(b"FRAME")
each = (len(data) - begin) // 100
frames = [data[begin + i * each + 6:begin + (i + 1) * each] for i in range(100)]
for name, bare in ("all", 0), ("some", 1):
    marks = [b"FRAME\n" if i < bare else b"FRAME Ip\n" for i in range(100)]
    open(name + ".y4m", "wb").write(data[:begin] + b"".join(m + f for m, f in zip(marks, frames)))
END
for range in "" "--frames 1-2" "--frames 40-99"; do
    check "bare lines $range" exits 0 weft convert held.y4m $box $all $range -o o.y4m
    for name in all some; do
        check "parameters of $name" exits 0 weft convert $name.y4m $box $all $range -o o2.y4m
        check "are the same" cmp o.y4m o2.y4m
        check "with --on-missing" exits 0 weft convert $name.y4m $box $all $range --on-missing hold -o o2.y4m
        check "too" cmp o.y4m o2.y4m
    done
done
for how in error hold; do
    check "chunks with $how" exits 2 weft convert all.y4m $box --chunk 2/3 --on-missing $how -o no.y4m
    check "take the number of pictures" says "known at its end only"
done

# ---- Joined ----

again="-mpegts_flags +initial_discontinuity"
coded wide.ts $again -vf scale=128:32 -c:v libx264
coded full.ts $again -pix_fmt yuv444p -c:v libx264
coded aspect.ts $again -vf setsar=4/3 -c:v libx264
coded tagged.ts $again -c:v libx264 -colorspace bt2020nc -color_primaries bt2020 -color_trc smpte2084
coded plain.ts -c:v libx264
for other in "wide is.128x32" "full yuv444p" "aspect pixels.of.another.aspect" "tagged other.colors"; do
    cat plain.ts "${other% *}.ts" >joined.ts
    check "${other% *} after plain" stops "frame 100 (1.000 s).*${other#* }" joined.ts --subframe-rate 100
done
check "may be missing" eval 'cat plain.ts wide.ts >joined.ts; exits 3 weft convert joined.ts $box --subframe-rate 100 --raster 64x32@100p --on-missing hold --report r.json -o o.y4m && [ "$(missing | wc -w)" = 100 ]'
cat plain.ts tagged.ts >joined.ts
check "times that begin again" stops "before picture 100 (1.000 s)" joined.ts
coded fields.ts $again -c:v libx264 -flags +ilme+ildct -x264-params tff=1
cat plain.ts fields.ts >joined.ts
check "fields after pictures" stops "frame 100 (1.000 s) is interlaced" joined.ts --subframe-rate 100
check "which is wrong" exits 0 weft convert joined.ts $box --subframe-rate 100 --input-scan progressive -o o.y4m

# ---- No video ----

quiet_ffmpeg -i b.mp4 -i late.mp4 -map 0:v -map 1:v -c copy -disposition:v:0 0 -disposition:v:1 default two.mp4
check "two streams of video" exits 0 weft convert two.mp4 ${box/-q/} -o o.y4m
check "are told" says "2 streams of video, and the first is taken"
check "the first alone" exits 0 weft convert b.mp4 $box -o o2.y4m
check "is the same" cmp o.y4m o2.y4m
quiet_ffmpeg -f lavfi -i sine=d=1 sound.wav
quiet_ffmpeg -f lavfi -i testsrc2=s=64x64:d=1 -frames:v 1 cover.png
quiet_ffmpeg -i sound.wav -i cover.png -map 0 -map 1 -c:v copy -disposition:v attached_pic cover.m4a
quiet_ffmpeg -i b.mp4 -i cover.png -map 1 -map 0 -c copy -disposition:v:0 attached_pic first.mp4
check "sound" stops "sound (WAV), which holds no video.*--audio" sound.wav
quiet_ffmpeg -i sound.wav sound.mka
check "sound in a container of video" stops "sound (Matroska / WebM), which holds no video.*--audio" sound.mka
check "as info says" fails "sound (Matroska / WebM), which holds no video" weft info sound.mka
check "sound and a cover" stops "only a picture as its cover" cover.m4a
check "a cover before the video" exits 0 weft convert first.mp4 $box -o o.y4m
check "video" exits 0 weft convert b.mp4 $box -o o2.y4m
check "is taken all the same" cmp o.y4m o2.y4m

# ---- Pictures of other kinds ----

quiet_ffmpeg -i b.mp4 -c copy -metadata:s:v rotate=90 turned.mov
check "turned" stops "turned by" turned.mov
coded pal.avi -pix_fmt pal8 -c:v rawvideo
check "a palette" stops "pixels are pal8.*ffmpeg" pal.avi
coded cinema.nut -pix_fmt xyz12le -c:v rawvideo
check "X'Y'Z' of digital cinema" stops "pixels are xyz12le.*ffmpeg" cinema.nut
for matrix in ycgco ictcp bt2020c; do
    coded matrix.mkv -c:v libx264 -colorspace $matrix
    check "$matrix" fails "matrix is number" weft convert matrix.mkv $box -o no.y4m
done
for pixels in gray gray10le gray16le gbrp gbrp12le rgb48le yuv410p yuv411p yuv440p yuv444p14le; do
    coded kind.mkv -pix_fmt $pixels -c:v ffv1
    check "$pixels" exits 0 weft convert kind.mkv $box -o o.y4m
done
check "nothing is left" [ ! -e no.y4m ]

finish
