#!/bin/bash
# The lines that answer questions on the site are run, and what the answers say of orders is so of the files. Scenes get
# two samples a cell, which is a tenth of the time and no other order.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized never
needs python3 ffmpeg ffprobe
needs_libav
ffmpeg -v error -encoders 2>/dev/null | grep -q libx264 || skip "ffmpeg without libx264"
ln -s "$WEFT_SOURCE/examples" examples
order() { ffprobe -v error -select_streams v:0 -show_entries stream=field_order -of default=nw=1:nk=1 "$1"; }

exits 0 weft render examples/scenes/carousel.lua --frames 0-5 --samples 2 -q -o clip.y4m || { cat said; exit 1; }
mapfile -t lines < <(sed -n 's/^    //p' examples/site/questions.md)
check "there are lines" test ${#lines[@]} -ge 12
for line in "${lines[@]}"; do
    line=${line/#ffmpeg/ffmpeg -v error -nostdin -y}
    [[ $line == *.mkv || $line == *.mp4 ]] && rm -f "${line##* }"
    [[ $line == "weft render"* ]] && line="$line --samples 2"
    read -ra words <<<"$line"
    check "$line" exits 0 "${words[@]}"
    case $line in
        *clip.mp4*) check "says bottom first" test "$(order clip.mp4)" = bb
            check "and shows it" verdict clip.mp4 bff ;;
        *setfield=bff*) check "shows what it did" verdict clip.mkv bff ;;
        *carousel.mp4*) check "says bottom first" test "$(order carousel.mp4)" = bb
            check "and shows it" verdict carousel.mp4 bff ;;
        *bwdif*) check "has no fields" verdict upload.mp4 progressive ;;
    esac
done

# What the answers warn of.
crop=crop=720:480:0
ffmpeg -v error -y -i clip.y4m -vf $crop:4 -c:v libx264 -flags +ildct+ilme told.mp4
check "libx264 says top first where it is told of fields alone" test "$(order told.mp4)" = tt
check "and shows bottom first" verdict told.mp4 bff
ffmpeg -v error -y -i clip.y4m -vf $crop:3 -c:v libx264 -x264-params bff=1 odd.mp4
check "an odd number of lines turns the order around" verdict odd.mp4 tff
ffmpeg -v error -y -i clip.y4m -vf $crop:4 -c:v libx264 plain.mp4
check "without flags it says progressive" test "$(order plain.mp4)" = progressive
finish
