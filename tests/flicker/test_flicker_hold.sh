#!/bin/bash
# Flicker that is weighed or bounded, of scenes, of samples that are stored, and what it costs.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "test-flicker holds flicker"
scenes=$WEFT_SOURCE/examples/scenes
# shellcheck disable=SC2054
small=(--raster 180x122@30i,tff --samples 9 --frames 0 -q --overwrite --temporal-width 0)

# What OpenEXR holds of one instant keeps the bound, of any scene that comes along.
one=(--raster 180x122@30psf --samples 9 --frames 0 -q --overwrite --temporal-width 0)
for scene in still carousel panorama slow_edges wheel; do
    for limit in 0.05 0.01; do
        weft render "$scenes/$scene.lua" "${one[@]}" --flicker-limit $limit -o 'held.####.exr'
        check "$scene is measured" exits 0 weft measure held.0000.exr --raster 180x122@30psf --json
        check "$scene within $limit" value "d['flicker']['p999'] <= $limit + 2e-4"
    done
done

# Both fields of a segmented frame are one picture, of which each column is solved once.
weft render "$scenes/wheel.lua" "${one[@]}" --flicker-limit 0.01 -o one.y4m --report one.json
solved=$(grep -o '"columns_solved": [0-9]*' one.json | grep -o '[0-9]*$')
check "columns are solved once" test "$solved" -gt 90 -a "$solved" -le 180
check "and are of two fields" grep -q '"fields": 2' one.json

# A weight, and the aperture that is one, make the same bytes; line is under both.
weft render "$scenes/still.lua" "${small[@]}" --flicker-weight 4 -o weight.y4m
weft render "$scenes/still.lua" "${small[@]}" --aperture least:4 -o aperture.y4m
weft render "$scenes/still.lua" "${small[@]}" --aperture line --flicker-weight 4 -o line.y4m
check "least:4 is a weight of 4" cmp weight.y4m aperture.y4m
check "line is under it" cmp weight.y4m line.y4m
weft render "$scenes/still.lua" "${small[@]}" --aperture line -o sharp.y4m
weft render "$scenes/still.lua" "${small[@]}" --aperture line --flicker-weight 0 -o none.y4m
check "a weight of 0 is none" cmp sharp.y4m none.y4m
echo '{"command": "render", "inputs": ["'"$scenes/still.lua"'"], "output": "job.y4m", "flicker-weight": "4"}' >job.json
check "as a job file" exits 0 weft render --job job.json "${small[@]}"
check "the same bytes" cmp weight.y4m job.y4m
check "dry" exits 0 weft render "$scenes/still.lua" "${small[@]}" --flicker-limit 0.02 -o dry.y4m --dry-run
check "nothing is there" test ! -e dry.y4m

# Stored samples: those of a field's own lines alone leave lines empty; trace draws all where it is told.
# shellcheck disable=SC2054
stored=(--raster 180x122@30i,tff --temporal-width 0 -q --overwrite)
weft trace "$scenes/carousel.lua" "${stored[@]}" --samples 9 --frames 0-1 --aperture line -o 'own.####.exr'
weft trace "$scenes/carousel.lua" "${stored[@]}" --samples 9 --frames 0-1 --flicker-limit 0.02 -o 'all.####.exr'
check "own lines are too few" fails "all lines" weft convert own.0000.exr own.0001.exr "${stored[@]}" --flicker-limit 0.02 -o x.y4m
check "all lines" exits 0 weft convert all.0000.exr all.0001.exr "${stored[@]}" --flicker-limit 0.02 -o deep.y4m
weft render "$scenes/carousel.lua" "${stored[@]}" --samples 9 --frames 0-1 --flicker-limit 0.02 -o direct.y4m
check "they are what render draws" cmp deep.y4m direct.y4m

# Fields that see nothing move are made once, whether they are held or not.
for skip in on off; do
    weft render "$scenes/still.lua" --raster 180x122@30i,tff --samples 4 --frames 0-3 -q --flicker-limit 0.02 --skip $skip \
        -o skip$skip.y4m --report $skip.json
done
check "skipping changes no byte" cmp skipon.y4m skipoff.y4m
check "and is done" test "$(grep -o '"fields_reused": [0-9]*' on.json | grep -o '[0-9]*$')" -gt 4

# The cost on the wheel, in processor seconds of the fastest of some runs each, in turn.
wheel=${WEFT_SHARED:-}/data/wheel
if [ -d "$wheel" ]; then
    cpu() { { TIMEFORMAT='%U %S'; time "$WEFT" convert "$wheel" --subframe-rate 480000/1001 -q --overwrite -o cost.y4m "$@"; } 2>&1 |
        awk '{ print $1 + $2 }'; }
    without=9 with=9
    for _ in 1 2 3 4 5; do
        without=$(printf '%s\n' "$without" "$(cpu)" | sort -n | head -n 1)
        with=$(printf '%s\n' "$with" "$(cpu --flicker-limit 0.02)" | sort -n | head -n 1)
    done
    ratio=$(awk "BEGIN { printf \"%.2f\", $with / $without }")
    echo "the wheel in 525i: $without s of processor, $with s with --flicker-limit 0.02: x $ratio"
    ! is_long || check "half as much again at most" test "$(awk "BEGIN { print $ratio <= 1.5 }")" = 1
else
    skip_part "no sample data: what a limit costs"
fi
finish
