#!/bin/bash
# Every command that may take long says within a second that it is at work, and from a fifth of its time on what is left.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "test_jobs.sh runs every command"
# Seconds of the clock are what this is about, and other work takes them.
python3 -c 'import os, sys; sys.exit(os.getloadavg()[0] > 2 * os.cpu_count())' || skip "the machine does too much else"
scene="$WEFT_SOURCE/examples/scenes/one_mover.lua"

# honest STAGE ARGUMENT..: one in four lines may be wrong, as other work comes and goes, which is why it may be so once
# in three times; on quiet machines none is.
honest()
{
    local stage=$1 try
    shift
    for try in 1 2 3; do
        python3 "$WEFT_SOURCE/tests/live/time_left.py" "$WEFT" "$@" >out
        value "d['status'] == 0 and d['first_s'] < 1 and d['stage'] == '$stage' and 4 * d['wrong'] <= d['lines']" && return
    done
    return 1
}

subframes in 96
check "pictures" honest convert convert in --subframe-rate 400 --raster 1080i50 --aperture calm -o shot.y4m --overwrite
check "a scene" honest render render "$scene" --raster 180x122@30i --frames 0-5 -o scene.y4m --overwrite
check "a scene to an error" honest render render "$scene" --raster 180x122@30i --frames 0-5 --error .01 -o error.y4m --overwrite
check "samples stored" honest trace trace "$scene" --raster 90x60@30i --frames 0-9 -o trace.####.exr --overwrite
check "subframes stored" honest trace trace "$scene" --raster 180x122@30p --frames 0-5 --oversample 2x2x4 -o sub.####.exr --overwrite
check "samples" honest convert convert trace.####.exr --raster 90x60@30i -o samples.y4m --overwrite
weft render "$scene" --raster 360x244@30i --frames 0-59 --samples 1 -o many.y4m
check "figures" honest measure measure many.y4m
check "a delivery" honest verify verify shot.y4m
weft convert in --subframe-rate 400 --raster 625i -o pal.y4m
check "a television" honest composite composite pal.y4m -o shown.y4m --overwrite

# A pipe does not say how many there are: nothing is made up.
weft render "$scene" --raster 1920x1080@50p --frames 0-3 --samples 1 --temporal-width 0 -o pipe.y4m
check "a pipe has no total" eval 'cat pipe.y4m | weft convert - --raster 1080i50 --from rec709 -o piped.y4m --progress json 2>out'
check "and says so" eval 'grep -q "\"frames_total\": 0,.*\"seconds_left\": null" out && ! grep -q "\"seconds_left\": [0-9]" out'
check "for logs" eval 'cat pipe.y4m | weft convert - --raster 1080i50 --from rec709 -o piped.y4m --overwrite --progress plain 2>out'
check "without a percentage" eval 'grep -q "convert: 0 frames" out && ! grep -q % out'
finish
