#!/bin/bash
# What pages are made of and what is refused: rasters, lengths, scans, planes, damage, sizes, names.
. "$WEFT_SOURCE/tests/program/script.sh"
needs python3
noise() { python3 -B "$WEFT_SOURCE/tests/page/noise.py" "$@"; }
told() { grep -qF -- "$1" "$2" || { echo "$2 does not say: $1"; return 1; }; }
page() { exits 0 weft page "$@" --overwrite -o look.html; }

noise a.y4m 64 36 3 It 422
noise b.y4m 64 36 2 Ib 420
noise wide.y4m 66 36 2 It 422
noise odd.y4m 33 34 2 It 422
noise odd_lines.y4m 64 35 2 It 422
noise quarters.y4m 64 36 2 It 411
noise gray.y4m 64 36 2 It mono
noise alpha.y4m 64 36 2 It 444alpha
noise unsaid.y4m 64 36 2 'I?' 422
noise progressive.y4m 64 36 2 Ip 422
noise none.y4m 64 36 0 It 422
sed '1s/F25:1/F30:1/' a.y4m >fast.y4m

# ---- What can be compared ----

check "clips of two orders, lengths and planes" page a.y4m b.y4m
check "that one is shorter is said" says "not equally long"
check "and on the page" told "Clips are not equally long: the first 2 frames" look.html
check "clips of two sizes" refuses "64x36 and wide.y4m 66x36" page a.y4m wide.y4m -o no.html
check "clips of two rates" refuses "25 frames a second and fast.y4m 30" page a.y4m fast.y4m -o no.html
check "progressive video" refuses "progressive" page progressive.y4m -o no.html
check "progressive video that is none" page progressive.y4m --raster '64x36@25i,tff'
check "video that does not say" page unsaid.y4m
check "is guessed, which is said" says "does not say how it is scanned"
check "and on the page, too" told "Guessed: how it is scanned" look.html
check "an odd number of lines" fails "35 lines" weft page odd_lines.y4m -o no.html
check "an odd width" page odd.y4m
check "four luma samples to a chroma sample" page quarters.y4m
check "a lone Y" page gray.y4m
check "alpha" page alpha.y4m
check "is left out, which is said" told "Left out: alpha" look.html
check "no frames" fails "no frame" weft page none.y4m -o no.html
check "too many clips" refuses "at most 16" page $(yes a.y4m | head -n 17) -o no.html

# ---- Other files ----

python3 -c "import sys; sys.stdout.buffer.write(bytes(range(256)) * 2 * 720 * 486)" | head -c $((2 * 720 * 486 * 2)) >raw.uyvy
if ! is_sanitized; then check "raw video" page raw.uyvy --raster 525i; fi
head -c 1000 raw.uyvy >short.uyvy
check "raw video that is no raster's" fails "short.uyvy" weft page short.uyvy -o no.html
subframes in 16
weft convert in --subframe-rate 480 --raster '60x40@30i,tff' -q -o p.####.png
weft convert in --subframe-rate 480 --raster '60x40@30i,tff' -q -o l.####.exr
weft convert in --subframe-rate 480 --raster '60x40@30i,tff,2020' --to rec2100-pq -q -o pq.y4m
if has_module oiio; then
    check "pictures" page 'p.####.png' --raster '60x40@30i,tff'
else
    skip_part "weft was built without OpenImageIO"
fi
check "linear light" page 'l.####.exr' --raster '60x40@30i,tff'
check "is said" told "Scene-linear light" look.html
check "a wider space" page pq.y4m --raster '60x40@30i,tff,2020'
check "is brought to the screen's, which is said" told "brought to Rec. 709" look.html
if has_libav; then
    weft convert in --subframe-rate 480 --raster 525i --codec v210 -q -o v.mov
    check "a container" page v.mov
fi

# ---- Damage ----

head -c 9000 a.y4m >cut.y4m
check "a cut file" fails "cut.y4m" weft page a.y4m cut.y4m -o no.html
echo "no video" >text.y4m
check "no video" fails "text.y4m" weft page text.y4m -o no.html
check "no file" fails "nowhere.y4m" weft page nowhere.y4m -o no.html
check "standard input" refuses "twice" page - -o no.html
check "no room" fails "allows no larger file" bash -c 'ulimit -f 8; exec "$WEFT" page a.y4m -o no.html -q'
check "no folder" fails "no/look.html" weft page a.y4m -o no/look.html
check "nothing half-written" test -z "$(ls -A | grep -E '^\.|^no\.')"

# ---- Options ----

check "some frames" page a.y4m --frames 1-2
check "are as many" told "4 fields of 64 by 36, 50 a second" look.html
check "frames that are not there" exits 2 weft page a.y4m --frames 7-9 -o no.html
check "are told" says "no frame 7"
check "frames in steps" refuses "one run of frames" page a.y4m --frames 0-2x2 -o no.html
check "frames below 0" refuses "from 0" page a.y4m --frames -3-2 -o no.html
check "names that HTML would take for its own" page a.y4m --title '<i>&"' --label '</script><b>'
check "are words" told '<h1>&lt;i&gt;&amp;&quot;</h1>' look.html
check "in data too" told '\u003c/script>\u003cb>' look.html
check "no name too many" refuses "--label" page a.y4m --label x --label y -o no.html
noise large.y4m 320 240 4 It 422
check "a page that is too large" fails "larger than 2 MB" weft page large.y4m large.y4m --max-size 2000000 -o no.html
check "is told with what would do" says "fewer frames, such as"
noise tall.y4m 640 480 1 It 422
check "one frame that is too large" fails "larger than 1 MB" weft page tall.y4m --max-size 1200000 -o no.html
check "is not told to show one" bash -c '! grep -q "frames, such as" said'
# Maps of where it flickers count: there is room for fields, and for half of the map.
weft page large.y4m -q -o sized.html
room=$(python3 -c 'import re, sys
text = open("sized.html").read()
fields, heat = (len(re.search(f"id=\"{kind}-0\">([^<]*)", text)[1]) for kind in ("fields", "heat"))
print((1 << 20) + fields + heat // 2)')
check "a page that its map makes too large" fails "flickers" weft page large.y4m --max-size "$room" -o no.html
check "a name that is no page" refuses "a page is HTML" page a.y4m -o no.txt
check "a page that is there" fails "exists" weft page a.y4m -o look.html
check "no name" refuses "-o look.html" page a.y4m
check "nothing to show" refuses "nothing to show" page -o no.html
check "nothing was written" test ! -e no.html -a ! -e no.txt

check "equal clips make equal pages" page a.y4m
mv look.html first.html
check "twice" page a.y4m
check "byte for byte" cmp look.html first.html
check "JSON of progress" exits 0 weft page a.y4m --overwrite -o look.html --progress json
check "ends with all frames" says '"frames_done": 3, "frames_total": 3'
finish
