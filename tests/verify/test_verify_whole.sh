#!/bin/bash
# weft verify on files that are not whole: streams that were cut, MXF that is still open, frames or sound that
# are missing from what lengths say.
. "$WEFT_SOURCE/tests/program/script.sh"

not_sanitized "test_jobs.sh verifies"
needs_libav
needs ffmpeg
subframes in 96
. "$WEFT_SOURCE/tests/verify/verdicts.sh"

check "MXF" made own.mxf --codec v210 "${small[@]}" --timecode 10:00:00:00 --audio silent:2
check "QuickTime" made m.mov --codec v210 "${small[@]}" --timecode 10:00:00:00 --audio silent:2
check "Matroska" made m.mkv --codec ffv1 "${small[@]}" --timecode 10:00:00:00 --audio silent:2

# Streams do not say where they end: what is left may be whole, and is never called so.
quiet_ffmpeg "${input[@]}" -c:v mpeg2video -c:a mp2 t.ts
quiet_ffmpeg "${input[@]}" -c:v mpeg2video -c:a mp2 p.mpg
check "a transport stream may go on" found whole t.ts open
check "a program stream may go on" found whole p.mpg open
head -c 20000 t.ts >within.ts
check "a packet that is cut" found whole within.ts wrong
head -c $((188 * 20)) t.ts >between.ts
check "a picture that is cut between packets" found whole between.ts wrong
head -c 20000 p.mpg >within.mpg
check "the same in a program stream" found whole within.mpg wrong
quiet_ffmpeg "${input[@]}" -f matroska -c:v ffv1 -c:a pcm_s16le - >live.mkv
check "Matroska of unknown size may go on" found whole live.mkv open
head -c $(($(stat -c %s live.mkv) - 100)) live.mkv >live_cut.mkv
check "but not end within a block" found whole live_cut.mkv wrong

# ---- Each check alone ----

check "a random index pack that lies" wrong whole own.mxf end - -12 0000000000000007
check "a header that is open" wrong header own.mxf status - 0 01
check "or closed and incomplete" wrong header own.mxf status - 0 02
check "QuickTime's media are longer" wrong durations m.mov atom +mdhd 16 00020000
check "or its track" wrong durations m.mov atom +tkhd 20 00000200
check "or its movie" wrong durations m.mov atom +mvhd 16 00000200
longer() { sed "s/00:00:00.$1/00:00:00.$2/" "$3" >"$4"; }
quiet_ffmpeg -i m.mkv -map 0:v -c copy -timecode 10:00:00:00 v.mkv
check "Matroska's tag is longer" longer 240000000 280000000 v.mkv tag.mkv
check "than its frames are" only durations tag.mkv
# A frame less, of a file that is whole otherwise.
quiet_ffmpeg -i v.mkv -c copy -frames:v 5 -timecode 10:00:00:00 five.mkv
check "five frames" right five.mkv
check "called six" longer 200000000 240000000 five.mkv six.mkv
check "are not" only durations six.mkv
quiet_ffmpeg -i m.mkv -f lavfi -t 0.1 -i anullsrc=r=48000 -map 0:v -map 1 -c:v copy -c:a pcm_s24le -timecode 10:00:00:00 short.mkv
check "sound that ends early in Matroska" only sound short.mkv
shared=$WEFT_SHARED/data/cases/hostile/nine_of_ten.mkv
if [ -e "${shared:-}" ]; then
    check "nine of ten" only whole "$shared"
else
    skip_part "nine_of_ten.mkv, as the sample data is not here"
fi
finish
