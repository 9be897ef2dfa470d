#!/bin/bash
# Scenes through the program as its users run it: the shipped scenes, the same bytes on any number
# of threads and in chunks, samples stored and taken up again, other renderers' samples, and what
# is refused.
. "$WEFT_SOURCE/tests/program/script.sh"
scenes=$WEFT_SOURCE/examples/scenes
width=180 lines=122
[ -z "${WEFT_SANITIZE:-}" ] || width=48 lines=36 # the sanitizers take ten times as long
small=(--raster "${width}x$lines@30i,tff,par=10:11")

refuses() { local words=$1; shift; exits 1 "$@" && grep -q -- "$words" said; }

# ---- The scenes that ship ----

for scene in "$scenes"/*.lua; do
    name=$(basename "$scene" .lua)
    check "$name renders" exits 0 weft render "$scene" "${small[@]}" --frames 0-1 --samples 4 \
        --set n=1000 -o "$name.y4m"
    check "$name makes no message" test ! -s said
    check "$name is two frames" test "$(wc -c <"$name.y4m")" -gt $((2 * width * lines * 4))
done

# ---- The same bytes ----

render=("$scenes/carousel.lua" "${small[@]}" --samples 8 --aperture diamond)
check "one thread" exits 0 weft render "${render[@]}" --frames 0-3 --threads 1 -o one.y4m
check "three threads" exits 0 weft render "${render[@]}" --frames 0-3 --threads 3 -o three.y4m
check "threads do not show" cmp one.y4m three.y4m
for n in 1 2 3; do
    check "chunk $n" exits 0 weft render "${render[@]}" --frames 0-3 --chunk $n/3 -o chunk$n.y4m
done
cat chunk1.y4m chunk2.y4m chunk3.y4m >chunks.y4m
check "chunks do not show" cmp one.y4m chunks.y4m
check "another seed" exits 0 weft render "${render[@]}" --frames 0-3 --seed 1 -o seed.y4m
check "a seed shows" bash -c '! cmp -s one.y4m seed.y4m'

# ---- What a scene does not need ----

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
[ -z "${WEFT_SANITIZE:-}" ] || idle=(shadow.lua sky.lua) ways=("${ways[@]:0:4}")
for how in "${ways[@]}"; do
    for scene in "${idle[@]}"; do
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

# ---- Stored and taken up again ----

# near A B: two EXR pictures are within the resampler's bound.
near() { oiiotool "$1" "$2" --fail 2e-6 --diff >diff.log 2>&1 || { cat diff.log; return 1; }; }

for how in '--aperture shaped' '--aperture diamond' '--aperture box --shutter-position center --temporal-width 3/2' \
    '--aperture notch --scan-skew 1 --temporal-width 0'; do
    # shellcheck disable=SC2086
    set -- "$scenes/carousel.lua" "${small[@]}" --samples 8 --frames 0-2 $how --overwrite
    check "render $how" exits 0 weft render "$@" -o r.####.exr
    check "trace $how" exits 0 weft trace "$@" -o d.####.exr
    # shellcheck disable=SC2086
    check "convert $how" exits 0 weft convert d.####.exr "${small[@]}" $how --overwrite -o c.####.exr
    if has oiiotool; then
        for n in 0 1 2; do check "frame $n of $how" near r.000$n.exr c.000$n.exr; done
    fi
done
check "subframes" exits 0 weft trace "$scenes/carousel.lua" "${small[@]}" --frames 0 \
    --oversample 2x2x4 -o sub.####.exr
check "eight of them" test "$(find . -name 'sub.*.exr' | wc -l)" = 8
check "which say what they are" exits 0 weft convert sub.####.exr "${small[@]}" -o sub.y4m
check "a raster that is not theirs" refuses "${width}x$lines" weft convert d.####.exr -o x.y4m
check "samples of half a field" exits 0 weft trace "$scenes/carousel.lua" "${small[@]}" --samples 8 \
    --frames 0 --overwrite -o d.####.exr
rm d.0001.exr d.0002.exr
check "samples that do not reach" refuses 'no sample reached' weft convert d.####.exr "${small[@]}" \
    --temporal-width 1/60 -o x.y4m
check "nothing is left of it" test ! -e x.y4m
check "or the nearest" exits 3 weft convert d.####.exr "${small[@]}" --temporal-width 1/60 \
    --on-empty nearest -o x.y4m

# ---- An error instead of a number of samples ----

# holds E A B REPORT: the difference of two pictures is at most the estimate, and that at most E.
holds()
{
    local is says
    is=$(oiiotool "$2" "$3" --diff | awk '/RMS/ { print $4 }')
    says=$(grep -o '"error_estimate": [0-9.e-]*' "$4" | awk '{ print $2 }')
    echo "error $1: estimated $says, is $is"
    awk -v e="$1" -v is="$is" -v says="$says" 'BEGIN { exit !(is <= says && says <= e && is > 0) }'
}

if has oiiotool; then
    for aperture in line shaped; do
        set -- "$scenes/carousel.lua" "${small[@]}" --frames 0 --aperture $aperture --to rec709 --overwrite
        check "converged" exits 0 weft render "$@" --samples 1024 --seed 9 -o converged.exr
        for error in 0.02 0.005; do
            check "to $error" exits 0 weft render "$@" --error $error -o spent.exr --report spent.json
            check "$aperture reaches $error" holds $error converged.exr spent.exr spent.json
        done
    done
fi

# ---- Other renderers ----

check "a renderer in C builds" ${CC:-cc} -O1 "$WEFT_SOURCE/examples/write_samples.c" -o write_samples \
    $(pkg-config --cflags --libs OpenEXR)
check "and writes" ./write_samples c.0000.exr 0 $width $lines
check "samples of C" exits 0 weft convert c.0000.exr "${small[@]}" --aperture box -o from_c.exr
if has python3; then
    check "Python writes" python3 "$WEFT_SOURCE/examples/write_samples.py" p.0000.exr 0 $width $lines
    check "samples of Python" exits 0 weft convert p.0000.exr "${small[@]}" --aperture box -o from_p.exr
    # The same picture from other samples at random.
    has oiiotool && check "are those of C" \
        bash -c 'oiiotool from_c.exr from_p.exr --diff | awk "/RMS/ { exit !(\$4 < 0.05) }"'
fi

# ---- Refused ----

check "no scene" exits 2 weft render -o x.y4m --overwrite
check "no such scene" refuses 'none.lua' weft render none.lua -o x.y4m --overwrite
echo 'camera{eye={0, 0, 1}, look_at={0, 0, 0}}
add(sphere{raduis=1})' >wrong.lua
check "line and suggestion" refuses 'wrong.lua:2: sphere: .*did you mean radius' \
    weft render wrong.lua -o x.y4m --overwrite
echo 'while true do end' >endless.lua
check "an endless loop" refuses 'endless.lua:1: .*steps' weft render endless.lua -o x.y4m --overwrite \
    --scene-steps 1000000
head -c 100 /dev/urandom >noise.lua
check "noise" exits 1 weft render noise.lua -o x.y4m --overwrite
check "frames with steps" exits 2 weft render "$scenes/still.lua" --frames 0-8x2 -o x.y4m --overwrite
check "samples that are video" exits 2 weft trace "$scenes/still.lua" -o x.y4m --overwrite
check "an option of another command" exits 2 weft render "$scenes/still.lua" --fit crop -o x.y4m
echo 'camera{eye={0, 0, 1}, look_at={0, 0, 0}}' >nothing.lua
check "a scene of nothing" exits 0 weft render nothing.lua "${small[@]}" --samples 1 -o nothing.y4m

# ---- Interrupted ----

"$WEFT" render "$scenes/carousel.lua" -o long.y4m 2>/dev/null &
sleep 1
kill -INT $!
wait $!
check "SIGINT" test $? = 130
check "leaves nothing" test ! -e long.y4m

finish
