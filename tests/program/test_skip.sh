#!/bin/bash
# What a scene does not need is skipped: pictures are the same with and without, and what was traced
# is counted.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "test_tracer.c skips"
scenes=$WEFT_SOURCE/examples/scenes
width=48 lines=36
is_long && ! is_sanitized && width=180 lines=122
small=(--raster "${width}x$lines@30i,tff,par=10:11")

# counted REPORT NAME: a count of the report.
counted() { grep -o "\"$2\": [0-9]*" "$1" | awk '{ print $2 }'; }

# A ball that nobody sees, whose shadow crosses what stands still.
cat >shadow.lua <<'EOF'
camera{eye={0, 3, 6}, look_at={0, 0, 0}, fov=45}
duration(0.4)
light{point={0, 6, 0}}
add(box{min={-4, -0.2, -4}, max={4, 0, 4}}:material{texture=checker{{0.9, 0.9, 0.9}, {0.2, 0.4, 0.2}, size=0.5}})
add(sphere{radius=0.4}:translate{-1, 5, 0}:velocity{10, 0, 0})
EOF
# A ball before nothing, and one that is there only while it is within another.
cat >sky.lua <<'EOF'
camera{eye={0, 0, 9}, look_at={0, 0, 0}, fov=45}
duration(0.4)
add(sphere{radius=0.5}:translate{-4, 1, 0}:velocity{60, 0, 0}:material{unlit=true})
add((sphere{radius=1}:translate{-3, -1, 0}:velocity{20, 0, 0} * sphere{radius=1}:translate{0, -1, 0})
    :material{unlit=true})
EOF
idle=(shadow.lua sky.lua "$scenes/one_mover.lua" "$scenes/still.lua" "$scenes/gallery.lua")
ways=('--temporal-width 3/2 --shutter-position center' '--raster 48x36@24psf --aperture line'
    '--scan-skew 1/2' '--error 0.01' '--aperture line' '--temporal-width 3 --aperture diamond'
    '--raster 48x36@24psf --temporal-width 5/2' '--raster 48x36@25p' '--temporal-width 2 --aperture box'
    '--temporal-width 0 --scan-skew 1 --error 0.01' '--error 0.01 --aperture box')
is_sanitized && idle=(shadow.lua sky.lua) ways=("${ways[@]:0:4}")
for how in "${ways[@]}"; do
    for scene in "${idle[@]}"; do
        is_long || [[ $scene$how != *gallery*error* && $scene$how != *gallery*psf* ]] || continue
        # shellcheck disable=SC2086
        set -- "$scene" "${small[@]}" --samples 4 --frames 0-5 $how --overwrite
        name="$(basename "$scene") $how"
        check "$name" exits 0 weft render "$@" -o skip.y4m --report skip.json
        check "$name --skip off" exits 0 weft render "$@" --skip off -o all.y4m --report all.json
        check "$name: skipping does not show" cmp skip.y4m all.y4m
        check "$name: something is skipped" \
            test "$(counted skip.json samples)" -lt "$(counted all.json samples)"
        check "$name: or nothing is" \
            test "$(counted all.json tiles_reused)$(counted all.json fields_reused)" = 00
    done
done
check "a still scene" exits 0 weft render "$scenes/still.lua" "${small[@]}" --samples 4 \
    --frames 0-5 --overwrite -o skip.y4m --report skip.json
check "is traced once" test "$(counted skip.json samples)" = $((4 * width * lines))
check "and gathered for each parity" test "$(counted skip.json fields_reused)" = 10
for how in '--samples 4' '--error 0.01'; do
    # shellcheck disable=SC2086
    set -- "$scenes/one_mover.lua" "${small[@]}" $how --frames 0-5 --overwrite
    check "frames from 3 on, $how" exits 0 weft render "$@" --chunk 2/2 -o second.y4m
    check "frames from 0 on, $how" exits 0 weft render "$@" --threads 3 -o whole.y4m
    bytes=$((3 * 2 * width * lines * 2))
    check "are alike" cmp <(tail -c $bytes second.y4m) <(tail -c $bytes whole.y4m)
done

finish
