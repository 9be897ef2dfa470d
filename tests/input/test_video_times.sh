#!/bin/bash
# Video whose pictures last unequally long, from files and from pipes.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "test_jobs.sh converts"
needs_libav
needs ffmpeg python3
. "$WEFT_SOURCE/tests/input/gray_video.sh"

# White for 6 ms and black for 14 is .3 of the light of each field: 64 + 876 * .3^(1 / 2.4).
y4m white.y4m "W64 H32 F100:1 Ip A1:1 C444p10" 100 940 64
for file in uneven.mkv uneven.mp4; do
    quiet_ffmpeg -i white.y4m -vf "settb=1/1000,setpts=floor(N/2)*20+mod(N\,2)*6" -fps_mode passthrough \
        -enc_time_base 1:1000 -c:v ${codec:-ffv1} ${codec:+-qp 0 -video_track_timescale 1000} $file
    codec=libx264
    check "times of $file" exits 0 weft convert $file $box -o u.y4m --report -
    check "weigh its pictures" first_code u.y4m 594 24
    check "and are told" value "d['input']['rate'] == {'value': 'irregular', 'reason': 'file'}"
done
check "some of them" exits 0 weft convert uneven.mkv $box --frames 10-59 -o u.y4m
check "weigh the same" first_code u.y4m 594 12
check "a rate in their place" exits 0 weft convert uneven.mkv $box --subframe-rate 100 -o u.y4m
check "makes pictures equal" first_code u.y4m 720 25
weft convert uneven.mkv $box -o u.y4m
check "uneven times of a pipe" exits 0 weft convert <(cat uneven.mkv) $box -o p.y4m --report -
check "are those of a file" cmp u.y4m p.y4m
check "and are told" value "d['input']['rate'] == {'value': 'irregular', 'reason': 'file'}"
for some in 10-59 0-98x2 1-99 7-98x3 20-99x2; do
    check "named pictures of a file" exits 0 weft convert uneven.mkv $box --frames $some -o u.y4m
    check "by a pipe" exits 0 weft convert <(cat uneven.mkv) $box --frames $some -o p.y4m --report -
    check "are the same ($some)" cmp u.y4m p.y4m
    check "and counted" value "d['input']['listed'] == $(python3 -c "a, _, s = '$some'.partition('x'); b, e = a.split('-'); print(len(range(int(b), int(e) + 1, int(s or 1))))")"
done
check "more than there are" fails "ends after 100 pictures.* 120 were expected" weft convert <(cat uneven.mkv) $box --frames 10-119 -o no.y4m
check "in a chunk" fails "out of step.*--chunk" weft convert <(cat uneven.mkv) $box --frames 10-59 --chunk 1/2 -o no.y4m
check "they must be even, and when" says "0.006 s"
# Even for a second, then a pause of .3 s, and twice as fast; windows that overlap and that are instants.
quiet_ffmpeg -i turns.y4m -vf "settb=1/90000,setpts=N*900+gte(N\,50)*27000-gte(N\,50)*(N-50)*450" -fps_mode passthrough \
    -enc_time_base 1:90000 -c:v libx264 -bf 2 -qp 0 late.ts
for how in "--aperture box --temporal-width 1" "--aperture line --temporal-width 0" "--aperture rotated" \
    "--aperture box --temporal-width 1 --subframe-time center"; do
    check "a pause" exits 0 weft convert late.ts $box $how -o u.y4m
    check "by a pipe" exits 0 weft convert <(cat late.ts) $box $how -o p.y4m
    check "is the same ($how)" cmp u.y4m p.y4m
    check "some of it" exits 0 weft convert late.ts $box $how --frames 31-90x2 -o u.y4m
    check "by a pipe" exits 0 weft convert <(cat late.ts) $box $how --frames 31-90x2 -o p.y4m
    check "are the same ($how)" cmp u.y4m p.y4m
done
check "frames of it" exits 0 weft convert late.ts $box --output-frames 10-20 -o u.y4m
check "by a pipe" exits 0 weft convert <(cat late.ts) $box --output-frames 10-20 -o p.y4m
check "are the same" cmp u.y4m p.y4m
quiet_ffmpeg -r 24 -i turns.y4m -vf "settb=1/90000,setpts=N*3750+gte(N\,50)*27000" -fps_mode passthrough \
    -enc_time_base 1:90000 -c:v libx264 -qp 0 film.ts
check "film" refuses "irregular" convert --from rec709 <(cat film.ts) $box --raster 64x32@30000/1001i --cadence 2:3 -o no.y4m

# Two pictures that are shown for nine seconds each: many fields see the same one.
quiet_ffmpeg -i turns.y4m -vf "settb=1/1000,setpts=N*10+if(gte(N\,50)\,9000)+if(gte(N\,51)\,9000)" -fps_mode passthrough \
    -enc_time_base 1:1000 -c:v libx264 -bf 2 -qp 0 still.mkv
for how in "--aperture box --temporal-width 1" "--aperture rotated"; do
    check "stills" exits 0 weft convert still.mkv $box $how -o u.y4m
    check "by a pipe" exits 0 weft convert <(cat still.mkv) $box $how -o p.y4m
    check "are the same ($how)" cmp u.y4m p.y4m
done

# AVI has times of decoding only, and of H.264 often an empty chunk after each picture.
if ffmpeg -v error -encoders | grep -q libx264; then
    for option in "-bf 0" "-bf 2" "-bf 2 -g 1"; do
        # shellcheck disable=SC2086
        quiet_ffmpeg -f lavfi -i testsrc2=s=64x32:r=30000/1001:d=2.002 -c:v libx264 $option coded.mp4
        quiet_ffmpeg -i coded.mp4 -c copy coded.avi
        check "H.264 in AVI ($option)" exits 0 weft convert coded.avi $box --from rec709 -o u.y4m --report -
        check "has its rate" value "d['input']['rate']['value'] == '30000/1001' and d['input']['listed'] == 60"
        check "as in MP4" exits 0 weft convert coded.mp4 $box --from rec709 -o p.y4m
        check "and its pictures" cmp u.y4m p.y4m
        check "some of them" exits 0 weft convert coded.avi $box --from rec709 --frames 30-49 -o u.y4m
        check "of MP4" exits 0 weft convert coded.mp4 $box --from rec709 --frames 30-49 -o p.y4m
        check "are the same" cmp u.y4m p.y4m
    done
    quiet_ffmpeg -i coded.mp4 -vf "select='mod(n,4)'" -fps_mode vfr -c:v libx264 -bf 2 fewer.avi
    check "pictures that AVI leaves out" exits 0 weft convert fewer.avi $box --from rec709 -o u.y4m --report -
    check "take their time" value "d['input']['listed'] == 45 and d['frames'] in (49, 50)"
else
    skip_part "no libx264"
fi

# ---- Times that will not do ----

# stamped FILE EXPRESSION: timestamps, in ms, of FFV1 in Matroska by a number N, patched into packets as they are.
stamped() { quiet_ffmpeg -i turns.y4m -c:v ffv1 -bsf:v "setts=ts=$2:time_base=1/1000" -time_base 1/1000 "$1"; }
stamped twice.mkv "N*10+if(gte(N\,50)\,-10)"
check "a time that repeats" fails "both shown at 0.490 s" weft convert twice.mkv $box -o no.y4m
check "by a pipe" fails "picture 50 is shown at 0.490 s" weft convert <(cat twice.mkv) $box -o no.y4m
stamped back.mkv "if(gte(N\,50)\,N*10-300\,N*10)"
check "times that run backwards" exits 1 weft convert back.mkv $box -o no.y4m
check "by a pipe" fails "picture 50 is shown at 0." weft convert <(cat back.mkv) $box -o no.y4m
check "a rate in their place" exits 0 weft convert <(cat back.mkv) $box --subframe-rate 100 -o p.y4m
check "makes pictures equal" first_code p.y4m 720 25
check "nothing is left" [ ! -e no.y4m ]

finish
