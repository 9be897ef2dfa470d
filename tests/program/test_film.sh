#!/bin/bash
# 2:3 pulldown as others see it: ffmpeg gets the film frames back, and weft measure sees film.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "test_cadence.c pulls down"

scene=$WEFT_SOURCE/examples/scenes/carousel.lua
small="--samples 4 -q --bits 8"

# body FILE: Y4M without its header.
body() { tail -c +"$(($(head -1 "$1" | wc -c) + 1))" "$1"; }

recovers()
{
    ffmpeg -nostdin -v error -y -i "$1" -vf fieldmatch="order=$2:combmatch=full",decimate \
        -pix_fmt yuv422p back.y4m && cmp <(body back.y4m) <(body "$3")
}

# shellcheck disable=SC2086
video() { weft render "$scene" $small "$@"; }

check "film" video --raster 180x122@23.976p --frames 0-15 -o film.y4m
for order in bff tff; do
    check "pulldown, $order" video --cadence 2:3 --raster 180x122@29.97i,$order --frames 0-19 -o $order.y4m
    check "$order is measured" weft measure $order.y4m --limit order.verdict=telecined
    has ffmpeg && check "ffmpeg's inverse gives the film, $order" recovers $order.y4m $order film.y4m
done

check "renders without skipping are the same" video --cadence 2:3 --raster 180x122@29.97i,bff \
    --frames 0-19 --skip off --chunk 2/2 -o part2.y4m
check "chunks are the run" cmp part2.y4m <(body bff.y4m | tail -c +$((10 * (180 * 122 * 2 + 6) + 1)) |
    head -c $((10 * (180 * 122 * 2 + 6))))

check "subframes of film" weft trace "$scene" -q --raster 180x122@23.976p --oversample 1x2x4 \
    --frames 0-11 -o 'sub.####.exr'
check "converted to film" weft convert 'sub.####.exr' -q --bits 8 --raster 180x122@23.976p \
    --subframe-rate 96000/1001 -o film2.y4m
check "and to fields, slowed" exits 0 weft convert 'sub.####.exr' --bits 8 --cadence 2:3 \
    --raster 180x122@29.97i,bff --subframe-rate 96 -o fields.y4m
check "which is said" says "96 subframes a second run at 96000/1001"
check "a film is measured" weft measure fields.y4m --limit order.verdict=telecined
has ffmpeg && check "ffmpeg gets it back" recovers fields.y4m bff film2.y4m

# Drop frame to the end of a day of 2589408 frames, and over it: ST 268-1 has the label at 1920.
label() { od -An -tx1 -j1920 -N4 "day.$1.dpx" | tr -d ' \n'; }
check "a day's last frames" weft render "$scene" --samples 1 -q --raster 16x12@29.97i,bff \
    --frames 2589406-2589408 --timecode '00:00:00;00' -o 'day.#######.dpx'
check "23:59:59;28" test "$(label 2589406)" = 23595968
check "23:59:59;29" test "$(label 2589407)" = 23595969
check "00:00:00;00" test "$(label 2589408)" = 00000040
check "past a minute" weft render "$scene" --samples 1 -q --raster 16x12@29.97i,bff --frames 0-1 \
    --timecode '00:08:59;29' -o 'day.#.dpx'
check "whose two first labels are left out" test "$(label 0000) $(label 0001)" = "00085969 00090042"

check "samples are refused" exits 2 weft trace "$scene" --raster 180x122@23.976p --cadence 2:3 -o 's.####.exr'
finish
