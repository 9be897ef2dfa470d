#!/bin/bash
# The scripter's guide does as it says: the program in C, the examples in Python, and the list of jobs.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "the tests of the library"
guide=$WEFT_SOURCE/examples/guides/scripter.md
cp "$WEFT_SOURCE/examples/scenes/carousel.lua" .
library=$(find "$WEFT_BUILD" -maxdepth 3 -name libweft.so | head -n 1)

# fenced WORD: the blocks of a language.
fenced() { sed -n "/^\`\`\`$1\$/,/^\`\`\`\$/p" "$guide" | grep -v '^```'; }

weft render carousel.lua --raster 525i --frames 0-1 --samples 1 -o tv.y4m -q
weft render carousel.lua --raster 36x24@30i,tff --frames 0-1 --samples 4 -o small.y4m -q
if [ -n "$library" ]; then
    fenced c >guide.c
    check "the program in C compiles" exits 0 "${CC:-cc}" -std=c17 -Wall -Wextra -Werror -I "$WEFT_SOURCE/convert" guide.c -o guide "$library" \
        "-Wl,-rpath,$(dirname "$library")"
    check "and runs" exits 0 ./guide small.y4m
    check "tells what the file is" prints '"kind": "video"'
    check "measures" prints '"flicker"'
    check "verifies" prints '"verdict": "right"'
    check "plans" prints 'number,time'
    check "reads" prints 'Y4M 422p10: 36 x 24, first'
    check "what is wrong is told" exits 1 ./guide none.y4m
    check "by the library" says 'none.y4m: No such file'
fi

python=
for candidate in /usr/bin/python3 python3; do
    "$candidate" -c 'import numpy' 2>/dev/null && python=$candidate && break
done
if [ -n "$python" ]; then
    export PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=$WEFT_BUILD/lib/python3/dist-packages
    rm tv.y4m
    check "the examples in Python" exits 0 "$python" -m doctest "$guide"
    [ $failed = 0 ] || head -n 60 out
    check "are there" test "$(grep -c '^>>>' "$guide")" -ge 18
else
    skip_part "no Python with NumPy"
fi

# The list of jobs, with shots of a few pixels in place of 1080i50.
mkdir a b
weft trace carousel.lua --raster 36x24@25i,tff --frames 0-1 --oversample 1x1x8 -o a/a.####.exr -q && cp a/* b
for shot in b/*; do mv "$shot" "b/b.${shot#b/a.}"; done
sed -n '/^    {"raster": "1080i50", "subframe-rate"/,/\]}/p' "$guide" | sed 's/1080i50/36x24@25i,tff/; s/\.mxf/.y4m/g' >reel.json
check "the list of jobs" exits 0 weft convert --job reel.json --report reel-report.json
check "makes both" test -s a.y4m -a -s b.y4m
finish
