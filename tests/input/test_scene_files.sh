#!/bin/bash
# Scene files as editors and people make them: marks of an encoding, what is printed, frames that are
# asked for, and scripts that mean harm.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "unit/tracer/test_hostile.c and test_advice.c do"

scene='camera{eye={0, 1, 6}, look_at={0, 0, 0}} light{point={4, 8, 5}} add(sphere{}:velocity{1, 0, 0})'
small=(--raster 16x12@25p --samples 1 --overwrite)

# ---- Marks ----

printf '\xef\xbb\xbf%s' "$scene" >bom.lua
check "a byte order mark is skipped" exits 0 weft render "${small[@]}" bom.lua -q -o bom.y4m
echo "include 'bom.lua'" >includes.lua
check "also in an included file" exits 0 weft render "${small[@]}" includes.lua -q -o included.y4m
check "and changes nothing" cmp bom.y4m included.y4m
for encoding in UTF-16 UTF-16LE UTF-16BE UTF-32; do
    python3 -c 'import sys; sys.stdout.buffer.write(sys.argv[2].encode(sys.argv[1]))' $encoding "$scene" >wide.lua
    check "$encoding is named" fails "wide.lua: it is in ${encoding:0:6}; save it as UTF-8" weft render "${small[@]}" wide.lua -o wide.y4m
done

# ---- What is said ----

echo "$scene print('hello', 3)" >prints.lua
weft render "${small[@]}" prints.lua -q -o - >prints.y4m 2>said
check "print goes to standard error" cmp said <(printf 'hello\t3\n')
check "and not into the output" cmp prints.y4m bom.y4m
warns() {
    local words=$1 && shift
    weft render "${small[@]}" "$@" >told 2>&1 && grep -q "warning: .*$words" told
}
echo "$scene sphere{}" >forgot.lua
check "a solid that is not added" warns 'forgot.lua:1: solid: it is not in the picture' forgot.lua -o f.y4m
check "a --set that nobody reads" warns '\-\-set: the scene does not read param.n' bom.lua --set n=3 -o f.y4m
echo "$scene camera{eye={0, 1, 6}, look_at={0, 1, 9}}" >away.lua
check "nothing in view" warns 'away.lua: nothing of the scene is in view' away.lua -o f.y4m
check "huge values of --set" exits 0 weft render "${small[@]}" bom.lua --set n=1e999 --set "m=$(printf '9%.0s' {1..100000})" -q -o f.y4m

# ---- Frames ----

echo "$scene duration(1)" >second.lua
check "frames past the duration" warns 'duration(1) of second.lua makes 25 frames' second.lua --frames 40 -o f.y4m
check "any one frame as a picture" exits 0 weft render "${small[@]}" second.lua -q --frames 20 -o still.png
check "is that frame" exits 0 weft render "${small[@]}" second.lua -q --frames 20 -o 'numbered.####.png'
check "of that number" cmp still.png numbered.0020.png
check "two frames need numbers" refuses 'there are 2 frames' render "${small[@]}" second.lua --frames 20-21 -o still.png
check "chunks need numbers" refuses 'in this chunk' render "${small[@]}" second.lua --frames 20-21 --chunk 1/2 -o still.png

echo "$scene add(sphere{center={0, 0, -3}}:material{reflect=.9}) depth(30)" >slow.lua
# A frame that would take minutes is left as soon as it has told twice how far it is.
within() { grep -c '"frame_part": 0\.[0-9]*[1-9]' progress; }
"$WEFT" render slow.lua --frames 0 --samples 65536 --raster 360x288@25p --overwrite --progress json -o slow.png 2>progress &
for _ in $(seq 200); do
    [ "$(within)" -lt 2 ] || break
    sleep 0.1
done
kill -INT $!
wait $!
check "progress within a frame" [ "$(within)" -ge 2 ]

# ---- Harm ----

echo 'for i = 1, 10000000 do add(sphere{center={i, 0, 0}}) end' | cat bom.lua - >many.lua
check "ten million solids" fails '64 MB; --scene-memory allows more' weft render "${small[@]}" many.lua --scene-memory 64M -o f.y4m
hostile=${WEFT_SHARED:-}/data/cases/hostile
for script in "$hostile"/{xp1,sort,cat}.lua; do
    [ -e "$script" ] || { skip_part "$hostile is not there"; break; }
    check "$(basename "$script") ends" fails 'more than 1000 steps' timeout 20 "$WEFT" render "${small[@]}" "$script" \
        --scene-steps 1000 -o f.y4m
done

finish
