#!/bin/bash
# Scenes through the program as its users run it: the shipped scenes, the same bytes on any number
# of threads and in chunks, and what is refused.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "test_jobs.sh renders"
scenes=$WEFT_SOURCE/examples/scenes
width=180 lines=122
is_sanitized && width=48 lines=36
small=(--raster "${width}x$lines@30i,tff,par=10:11")

# ---- The scenes that ship ----

for scene in "$scenes"/*.lua; do
    name=$(basename "$scene" .lua)
    set -- "$scene" "${small[@]}" --frames 0-1 --samples 4
    [ "$name" != csg_grid ] || set -- "$@" --set n=1000
    check "$name renders" exits 0 weft render "$@" -o "$name.y4m"
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

# ---- Refused ----

check "no scene" exits 2 weft render -o x.y4m --overwrite
check "no such scene" fails 'none.lua' weft render none.lua -o x.y4m --overwrite
echo 'camera{eye={0, 0, 1}, look_at={0, 0, 0}}
add(sphere{raduis=1})' >wrong.lua
check "line and suggestion" fails 'wrong.lua:2: sphere: .*did you mean radius' \
    weft render wrong.lua -o x.y4m --overwrite
echo 'while true do end' >endless.lua
check "an endless loop" fails 'endless.lua:1: .*steps' weft render endless.lua -o x.y4m --overwrite \
    --scene-steps 1000000
head -c 100 /dev/urandom >noise.lua
check "noise" exits 1 weft render noise.lua -o x.y4m --overwrite
check "frames with steps" exits 2 weft render "$scenes/still.lua" --frames 0-8x2 -o x.y4m --overwrite
check "samples that are video" exits 2 weft trace "$scenes/still.lua" -o x.y4m --overwrite
check "an option of another command" exits 2 weft render "$scenes/still.lua" --fit crop -o x.y4m
echo 'camera{eye={0, 0, 1}, look_at={0, 0, 0}}' >nothing.lua
check "a scene of nothing" exits 0 weft render nothing.lua "${small[@]}" --samples 1 -o nothing.y4m

# ---- Interrupted ----

check "SIGINT" interrupted INT 130 1 "$WEFT" render "$scenes/carousel.lua" -o left/long.y4m

finish
