#!/bin/bash
# The farm scripts of examples/farm without a farm: parts, what they are held to, what is joined,
# and GNU parallel. tests/program/test_slurm.sh has the same on Slurm.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized never
farm=$WEFT_SOURCE/examples/farm
export WEFT

subframes made 16
mkdir "in put"
for ((k = 0; k < 96; k++)); do
    ln -s "../made/subframe.$(printf %04d $((k % 16))).exr" "in put/s.$(printf %04d $k).exr"
done
from=("in put" --subframe-rate 480000/1001 --raster "360x244@30000/1001i,bff")
mkdir single farmed
for output in "a b.y4m" a.v210 "f.%03d.dpx"; do
    check "$output" exits 0 weft convert "${from[@]}" -o "single/$output"
done

# in_parts OUTPUT: three parts in an order of their own, joined.
in_parts()
{
    local i
    for i in 2 3 1; do "$farm/chunk.sh" $i 3 "farmed/$1" "${from[@]}" || return; done
    "$farm/join.sh" 3 "farmed/$1" "${from[@]}"
}
for output in "a b.y4m" a.v210 "f.%03d.dpx"; do
    check "$output in parts" exits 0 in_parts "$output"
done
check "parts are the whole" diff -r single farmed
for i in {1..9}; do
    check "more parts than frames" exits 0 "$farm/chunk.sh" $i 9 nine.y4m "${from[@]}"
done
check "joined" exits 0 "$farm/join.sh" 9 nine.y4m "${from[@]}"
check "are the whole as well" cmp nine.y4m "single/a b.y4m"
check "a part of what is joined" exits 0 "$farm/chunk.sh" 4 9 nine.y4m "${from[@]}"
check "is not made again" prints "nothing to do"
check "and what is joined" exits 0 "$farm/join.sh" 9 nine.y4m "${from[@]}"
check "is left alone" prints "nothing to do"

# ---- What is missing, cut, or of another job ----

check "part 1" exits 0 "$farm/chunk.sh" 1 3 x.y4m "${from[@]}"
check "progress" says "2 of 2 frames (100%)"
check "join too early" exits 1 "$farm/join.sh" 3 x.y4m "${from[@]}"
check "what is missing is named" says "not there or not whole: 2 3;"
check "nothing is joined" test ! -e x.y4m
check "parts of another number" exits 2 "$farm/chunk.sh" 2 4 x.y4m "${from[@]}"
check "parts of another aperture" exits 2 "$farm/chunk.sh" 2 3 x.y4m "${from[@]}" --aperture box
check "are kept out" says "parts of another job"
check "part 2" exits 0 "$farm/chunk.sh" 2 3 x.y4m "${from[@]}"
check "part 3" exits 0 "$farm/chunk.sh" 3 3 x.y4m "${from[@]}"
stat -c '%i %Y' x.y4m.parts/[13]of3.y4m >before
truncate -s -1 x.y4m.parts/2of3.y4m
check "a part that is cut" exits 1 "$farm/join.sh" 3 x.y4m "${from[@]}"
check "is named" says "not whole: 2;"
for i in 1 2 3; do check "again" exits 0 "$farm/chunk.sh" $i 3 x.y4m "${from[@]}"; done
check "only that was made again" diff before <(stat -c '%i %Y' x.y4m.parts/[13]of3.y4m)
echo mine >x.y4m
check "an output that appeared" exits 1 "$farm/join.sh" 3 x.y4m "${from[@]}"
check "is left alone" test "$(cat x.y4m)" = mine
rm x.y4m
check "joined" exits 0 "$farm/join.sh" 3 x.y4m "${from[@]}"
check "and right" cmp x.y4m "single/a b.y4m"
check "the parts are gone" test ! -e x.y4m.parts
check "part 0" exits 2 "$farm/chunk.sh" 0 3 y.y4m "${from[@]}"
check "a failure is one" exits 1 "$farm/chunk.sh" 1 3 y.y4m absent.####.exr --subframe-rate 240

# Frames that were held: weft ends with 3, which is told in the end and keeps nobody waiting.
cp -r "in put" holed
rm holed/s.0065.exr
hold=(holed/s.####.exr "${from[@]:1}" --on-missing hold)
for i in 1 2 3; do check "part with a hole" exits 0 "$farm/chunk.sh" $i 3 h.y4m "${hold[@]}"; done
check "a join of held frames" exits 3 "$farm/join.sh" 3 h.y4m "${hold[@]}"
check "says which" says "in parts 3"

# ---- GNU parallel ----

if has parallel; then
    check "parallel" exits 0 "$farm/parallel.sh" 3 "p q.y4m" "${from[@]}"
    check "is the whole" cmp "p q.y4m" "single/a b.y4m"
    check "parallel again" exits 1 "$farm/parallel.sh" 3 "p q.y4m" "${from[@]}"
    check "is refused" says "exists"

    # A weft that dies the first time it is asked for part 2, after some frames.
    cat >dying <<'SCRIPT'
#!/bin/bash
if [[ "$*" == *2/3* ]] && mkdir died 2>/dev/null; then
    "$REAL" "${@/2\/3/4/9}"
    exit 137
fi
exec "$REAL" "$@"
SCRIPT
    chmod +x dying
    mkdir frames whole
    cp single/f.0*.dpx whole
    export REAL=$WEFT
    WEFT=$work/dying
    check "parallel with a death" exits 0 "$farm/parallel.sh" 3 "frames/f.%03d.dpx" "${from[@]}"
    check "it died" test -d died
    check "all frames are there, and right" diff -r frames whole
    check "braces" exits 2 "$farm/parallel.sh" 3 "{x}.y4m" "${from[@]}"
fi

finish
