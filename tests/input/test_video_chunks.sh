#!/bin/bash
# Video is entered in its middle: chunks, spans and farms make bit for bit what one run makes.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "test_jobs.sh converts"
needs python3

# 90 pictures of 4:2:0, 100 a second: gray that differs from picture to picture, and noise that moves.
python3 - <<'P'
import random
random.seed(1)
noise = bytes(random.randint(16, 235) for _ in range(96 * 64))
with open("any.y4m", "wb") as f:
    f.write(b"YUV4MPEG2 W96 H64 F100:1 Ip A1:1 C420mpeg2\n")
    for k in range(90):
        row = noise[37 * k % 4096:][:1536]
        f.write(b"FRAME\n" + row + bytes([60 + k]) * 1536 + noise[k:][:3072] + bytes([100 + k % 50]) * 3072)
P

slow="--raster 96x64@25i --aperture rotated --bits 10 --dither none -q --overwrite"

# whole_by_chunks FILE: three chunks of it, joined, are the run.
whole_by_chunks()
{
    local n
    exits 0 weft convert "$1" $slow -o whole.y4m || return 1
    for n in 1 2 3; do exits 0 weft convert "$1" $slow --chunk $n/3 -o chunk$n.y4m || return 1; done
    cat chunk[1-3].y4m | cmp - whole.y4m
}

# spans FILE: frames of a run by their numbers, and pictures by theirs, are those of the whole file's.
spans()
{
    local size=$((96 * 64 * 4 + 6))
    exits 0 weft convert "$1" $slow -o whole.y4m || return 1
    exits 0 weft convert "$1" $slow --output-frames 12-17 -o some.y4m || return 1
    cmp <(tail -c $((6 * size)) some.y4m) <(tail -c +$(($(stat -c %s whole.y4m) - ($2 - 12) * size + 1)) whole.y4m |
        head -c $((6 * size))) || return 1
    exits 0 weft convert "$1" $slow --frames 40-79 -o some.y4m || return 1
    exits 0 weft convert <(cat "$1") $slow --frames 40-79 -o piped.y4m || return 1
    cmp some.y4m piped.y4m
}

check "chunks of Y4M" whole_by_chunks any.y4m
check "spans of Y4M" spans any.y4m 22
cat any.y4m | "$WEFT" convert - $slow --frames 0-89 --chunk 2/3 -o p.y4m
check "a chunk of a pipe whose pictures are numbered" cmp p.y4m chunk2.y4m

if has_libav && has ffmpeg; then
    # coded NAME OPTION..
    coded() { quiet_ffmpeg -i any.y4m "${@:2}" "$1"; }
    coded b.mp4 -c:v libx264 -bf 3 -g 20
    coded b.mkv -c:v libx264 -bf 3 -g 20 -x264-params open-gop=1
    coded b.ts -c:v libx264 -bf 3 -g 20 -x264-params open-gop=1
    coded refresh.mkv -c:v libx264 -x264-params intra-refresh=1:keyint=20
    coded m2.ts -c:v mpeg2video -r 50 -bf 2 -g 12 -q 3
    coded m2.m2v -c:v mpeg2video -r 50 -bf 2 -g 12 -q 3
    coded ffv1.avi -c:v ffv1 -g 10
    coded h263.avi -c:v mpeg4 -bf 2 -g 12 -q 3
    quiet_ffmpeg -ss 0.123 -i b.mp4 -c copy edits.mov
    quiet_ffmpeg -i any.y4m -vf "settb=1/1000,setpts=floor(N/2)*20+mod(N\,2)*6" -fps_mode passthrough \
        -enc_time_base 1:1000 -c:v libx264 -bf 2 -g 15 uneven.mkv
    for file in b.mp4 b.mkv b.ts refresh.mkv m2.ts m2.m2v ffv1.avi h263.avi edits.mov uneven.mkv; do
        check "chunks of $file" whole_by_chunks $file
    done
    check "spans of H.264 in MP4" spans b.mp4 22
    check "spans of H.264 in a transport stream" spans b.ts 22

    # What is long before is not decoded: it may even be damaged.
    cp b.mp4 hurt.mp4
    head -c 400 /dev/zero | dd of=hurt.mp4 bs=1 seek=4000 conv=notrunc 2>dd.said
    check "damage" fails "frame [0-9]* (0" weft convert hurt.mp4 $slow -o no.y4m
    check "is not met by a later chunk" exits 0 weft convert hurt.mp4 $slow --chunk 5/5 -o c.y4m
    weft convert b.mp4 $slow --chunk 5/5 -o d.y4m
    check "which is what it was" cmp c.y4m d.y4m
fi

# ---- Film ----

# Pictures of film are what subframes of film are.
film="--raster 96x64@30000/1001i,bff --cadence 2:3 --aperture box --temporal-width 0 --overwrite"
check "video of 100 a second" exits 2 weft convert any.y4m $film -o no.y4m
check "is no film" says "and not 100 pictures a second"
for rate in 24:1 24000:1001; do
    sed "1s/F100:1/F$rate/" any.y4m >film.y4m
    check "film of $rate" exits 0 weft convert film.y4m $film --bits 8 -o fields.y4m --report -
    check "is 5 frames of 4" value "d['frames'] == 112"
    check "is seen as such" exits 0 weft measure fields.y4m --limit order.verdict=telecined
    check "by a pipe" bash -c "cat film.y4m | '$WEFT' convert - $film -q --bits 8 -o piped.y4m"
    check "is the same" cmp fields.y4m piped.y4m
done
sed "1s/F100:1/F24:1/" any.y4m >film.y4m
check "24 is slowed" exits 0 weft convert film.y4m $film --bits 8 -o fields2.y4m
check "which is said" says "24 pictures a second run at 24000/1001"
check "and is the same" cmp fields.y4m fields2.y4m
check "25" bash -c "sed '1s/F100:1/F25:1/' any.y4m >pal.y4m"
check "is refused" exits 2 weft convert pal.y4m $film -o no.y4m
if has_libav && has ffmpeg; then
    quiet_ffmpeg -i film.y4m -c:v ffv1 film.mkv
    check "milliseconds of 24 by a pipe" bash -c "cat film.mkv | '$WEFT' convert - $film -q --bits 8 -o piped.y4m"
    check "are the same" cmp fields.y4m piped.y4m
    check "times without a rate" refuses "irregular" convert uneven.mkv --from rec709 $film -o no.y4m
fi
check "nothing is left" [ ! -e no.y4m ]

finish
