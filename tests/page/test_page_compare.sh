#!/bin/bash
# convert and render with --compare, a page in one step, and with --preview, a frame for a computer's screen.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "test_page_inputs makes pages"
needs python3
subframes in 32
raster=(--raster '90x64@30i,tff,par=10:11' --subframe-rate 480)
export TMPDIR=$work/temporary
mkdir temporary

# ---- One page of several runs ----

list=box,shaped,least:4,line+limit=.06,mitchell:1,0,line+weight=2+limit=visible:1
check "a page of six apertures" exits 0 weft convert in "${raster[@]}" --compare $list -o look.html --progress plain
check "progress is told" says "12 of 12 frames"
check "nothing is left where the clips were" test -z "$(ls -A temporary)"
check "each clip has its entry for a name" python3 - <<'END'
import json, re
text = open("look.html", encoding="utf-8").read()
data = json.loads(re.search(r'id="player-data">(.*?)</script>', text, re.S).group(1))
labels = [v["label"] for v in data["clips"][0]["variants"]]
assert labels == ["box", "shaped", "least:4", "line+limit=.06", "mitchell:1,0", "line+weight=2+limit=visible:1"], labels
END
# The same as page makes of runs one by one, told their raster, which Y4M does not say.
weft convert in "${raster[@]}" --aperture box -q -o box.y4m
weft convert in "${raster[@]}" --aperture line --flicker-limit .06 -q -o line.y4m
weft page box.y4m line.y4m --raster "${raster[1]}" --label box --label line+limit=.06 -q -o by_hand.html
check "two of them" exits 0 weft convert in "${raster[@]}" --compare box,line+limit=.06 -q -o two.html
check "the page is the one that page makes of both videos" cmp two.html by_hand.html
# What the command line holds goes for entries that say nothing else.
weft convert in "${raster[@]}" --aperture line --flicker-weight 2 -q -o weighed.y4m
weft page weighed.y4m --raster "${raster[1]}" --label line -q -o by_hand.html --overwrite
check "a weight of the command line" exits 0 weft convert in "${raster[@]}" --flicker-weight 2 --compare line \
    -q -o weighed.html
check "is that of the page" cmp weighed.html by_hand.html
check "render compares too" exits 0 weft render "$WEFT_SOURCE/examples/scenes/zoneplate.lua" \
    --raster '48x36@25i,tff' --frames 0-1 --samples 4 --compare box,shaped -q -o rendered.html
echo "{\"inputs\": [\"in\"], \"subframe-rate\": 480, \"raster\": \"90x64@30i,tff\", \"compare\": \"box\", \"output\": \"job.html\"}" >job.json
check "a job file may ask for it" exits 0 weft convert --job job.json -q
check "beside the file" test -s job.html

check "what all entries are warned of" exits 0 weft convert in --raster '48x64@30i,tff' --subframe-rate 480 --compare box,shaped,line -o warned.html
check "is said once" same "$(grep -c 'it will be stretched' said)" 1

no=("${raster[@]}" -o no.html)
check "an aperture that is none" refuses "shapd" convert in "${no[@]}" --compare box,shapd
check "what is held and is none" refuses "+limit=E" convert in "${no[@]}" --compare box+much=3
check "a limit that is none" refuses "flicker-limit" convert in "${no[@]}" --compare box+limit=-3
check "an empty entry" refuses "is empty" convert in "${no[@]}" --compare box,
check "a progressive raster" refuses "progressive" convert in --raster 1080p25 --compare box -o no.html
check "a page that is video" refuses "page is HTML" convert in "${raster[@]}" --compare box -o no.y4m
check "video that is a page" refuses "--compare box,shaped" convert in "${no[@]}"
check "a page without a name" refuses "where to" convert in "${raster[@]}" --compare box
check "a chunk" refuses "--chunk" convert in "${no[@]}" --compare box --chunk 1/2
check "a report" refuses "--report" convert in "${no[@]}" --compare box --report r.json
check "a page that is there" fails "exists" weft convert in "${raster[@]}" --compare box -o look.html
check "an input that is not" fails "" weft convert nowhere "${no[@]}" --compare box
check "no place for clips" fails "TMPDIR" env TMPDIR=$work/nowhere "$WEFT" convert in "${no[@]}" --compare box
check "nothing of these was written" test ! -e no.html -a -z "$(ls -A temporary)"
check "a limit twice" refuses "+limit= twice" convert in "${no[@]}" --compare box+limit=.06+limit=.1
check "sound" refuses "--audio" convert in "${no[@]}" --compare box --audio in.wav
check "an option that its video cannot have" refuses "box: 4:2:2 takes an even width" convert in \
    --subframe-rate 480 --raster '17x16@30i,tff' --compare box -o no.html
check "a page that is a hash" refuses "-o look.html" convert in "${raster[@]}" --compare box -o hash:no.html
check "a page that is nothing" refuses "-o look.html" convert in "${raster[@]}" --compare box -o null:no.html
check "a frame without a preview" refuses "--preview" convert in "${no[@]}" --compare box --preview-frame 1
check "nothing of these, either" test ! -e no.html -a ! -e hash:no.html -a -z "$(ls -A temporary)"

# A page shows the raster and the space that were asked for, which the video alone does not say.
check "segmented frames" exits 0 weft convert in --subframe-rate 480 --raster '60x40@30psf' --compare box -q -o psf.html
weft convert in --subframe-rate 480 --raster '60x40@30i,tff' --to rec2100-pq --compare box -q -o pq.html
check "a page of PQ" grep -q "brought to Rec. 709" pq.html
weft convert in --subframe-rate 480 --raster '60x40@30i,bff,2020' --compare line+limit=.06 -q -o wide.html
check "a page of a wider space" grep -q "brought to Rec. 709" wide.html
weft convert in --subframe-rate 480 --raster '60x40@30i,bff,2020' --aperture line --flicker-limit .06 -q -o wide.y4m
weft page wide.y4m --raster '60x40@30i,bff,2020' --label line+limit=.06 -q -o by_hand.html --overwrite
check "is the one that page makes, told the raster" cmp wide.html by_hand.html
check "a clip in which something is wrong" fails "^weft: box: measuring .*max-memory" weft convert in \
    --subframe-rate 480 --raster '640x480@30i,tff' --compare box --max-memory 42M -q -o no.html
mkdir left
check "an interrupted page" interrupted INT 130 1 "$WEFT" render "$WEFT_SOURCE/examples/scenes/carousel.lua" \
    --compare box,shaped -q -o left/look.html
check "leaves no clips" test -z "$(ls -A temporary)"

# ---- Previews ----

# square.py PNG WxH EXPRESSION: it is a whole PNG of that size of which that is so.
cat >square.py <<'END'
import sys, png
width, lines, rows = png.read(sys.argv[1])
assert (width, lines) == tuple(map(int, sys.argv[2].split("x"))), (width, lines)
# A comb: a line that is far from both neighbors, on the same side.
comb = sum(min(abs(b - a), abs(b - c)) > 24 and (b > a) == (b > c)
           for y in range(1, lines - 1) for a, b, c in zip(rows[y - 1][::3], rows[y][::3], rows[y + 1][::3]))
share = comb / width / lines
assert eval(sys.argv[3], {"share": share, "rows": rows}), share
END
export PYTHONPATH="$WEFT_SOURCE/tests/page" PYTHONDONTWRITEBYTECODE=1
preview() { python3 square.py "$@"; }
check "a video and its preview" exits 0 weft convert in --subframe-rate 480 --raster '180x122@30i,tff,par=10:11' \
    --aperture box -q -o shot.y4m --preview shot.png
check "has square pixels and no comb" preview shot.png 164x122 "share < 0.004"
check "a frame of finished video" exits 0 weft page shot.y4m --preview frame.png --preview-frame 1
check "the middle one is that of the run" cmp frame.png shot.png
check "another is another" exits 0 weft page shot.y4m --preview first.png --preview-frame 0
differ() { ! cmp -s "$1" "$2"; }
check "indeed" differ first.png shot.png
if has_module oiio; then
    check "pictures that are a video" exits 0 weft convert in --subframe-rate 480 --raster '60x40@30i,tff' -q \
        -o pictures.####.png --preview pictures.png
    check "have one too" preview pictures.png 60x40 "True"
else
    skip_part "weft was built without OpenImageIO"
fi
check "progressive video" exits 0 weft convert in --subframe-rate 480 --raster '60x40@60p' -q -o p.y4m --preview p.png
check "video without light" exits 0 weft convert in --subframe-rate 480 --raster '60x40@30i,tff' --exposure -32 -q \
    -o black.y4m --preview black.png
check "has a black preview" preview black.png 60x40 "all(not any(row) for row in rows)"
check "a preview that is no PNG" refuses "PNG" convert in "${raster[@]}" -o x.y4m --preview x.jpg
check "a preview of a pipe" refuses "--preview" convert in "${raster[@]}" -o - --preview x.png
check "a preview of a dry run" refuses "--preview" convert in "${raster[@]}" -o x.y4m --dry-run --preview x.png
check "a frame that is none" refuses "preview-frame" convert in "${raster[@]}" -o x.y4m --preview x.png --preview-frame -1
check "a preview that is there" fails "exists" weft convert in "${raster[@]}" -o x.y4m --preview shot.png
check "nothing of these was written" test ! -e x.y4m -a ! -e x.png
check "a frame that is not there" exits 2 weft page shot.y4m --preview x.png --preview-frame 2
check "is told with what there is" says "it has 2"

check "a frame without a preview" refuses "--preview" page shot.y4m -o x.html --preview-frame 1
check "that, of a run" refuses "--preview" convert in "${raster[@]}" -o x.y4m --preview-frame 1
check "a page whose name will not do" refuses "a page is HTML" page shot.y4m --preview x.png -o x.txt
for output in null: hash:x.md5; do
    check "a preview of $output" refuses "--preview looks at" convert in "${raster[@]}" -o $output --preview x.png
done
check "nothing was made first" test ! -e x.png -a ! -e x.md5 -a ! -e x.y4m

# What is read or written beside it is not replaced.
mkdir other
check "a frame of the output" refuses "would replace" convert in "${raster[@]}" -o pa.####.png --preview pa.0000.png
check "that, by another way" refuses "would replace" convert in "${raster[@]}" -o pa.####.png --preview ./other/../pa.0007.png
check "the report" refuses "would replace" convert in "${raster[@]}" -o x.y4m --report r.png --preview r.png
cp shot.y4m shot.html
check "a page over its clip" refuses "would replace" page shot.html -o shot.html --overwrite
cp shot.y4m own.png
check "a preview over its clip" refuses "would replace" page own.png --preview own.png --overwrite
ln -s own.png link.png
check "that, by a link" refuses "would replace" page own.png --preview link.png --overwrite
check "clips are as they were" cmp shot.y4m shot.html

# Codes of PQ and HLG are light before they are codes of the screen: as bright as those of Rec. 709.
cat >alike.py <<'END'
import sys, png
def mean(path):
    width, lines, rows = png.read(path)
    return sum(map(sum, rows)) / width / lines / 3
a, b = mean(sys.argv[1]), mean(sys.argv[2])
assert abs(a - b) < 4, (a, b)
END
bright=(--subframe-rate 480 --raster '60x40@30i,tff' -q)
weft convert in "${bright[@]}" -o sdr.y4m --preview sdr.png
for space in rec2100-pq rec2100-hlg; do
    check "a preview of $space" exits 0 weft convert in "${bright[@]}" --to $space -o $space.y4m --preview $space.png
    check "is as bright" python3 alike.py $space.png sdr.png
done

# Sizes and shapes that few files have: an odd number of lines, one line, pixels that are wide.
noise() { python3 -B "$WEFT_SOURCE/tests/page/noise.py" "$@"; }
for size in 17x15 16x1 1x7 3x2; do
    for chroma in 444 422 mono; do
        noise odd.y4m ${size%x*} ${size#*x} 2 It $chroma
        check "a preview of $size $chroma" exits 0 weft page odd.y4m --preview odd.png --overwrite
        check "is as large" preview odd.png "$size" True
    done
done
check "a run of an odd number of lines" exits 0 weft convert in --subframe-rate 480 --chroma 444 \
    --raster '17x15@30000/1001p' -q -o po.y4m --preview po.png
check "has a preview" preview po.png 17x15 True
for aspect in A999999999:1 A1:999999999 A40:1; do
    sed "1s/A1:1/$aspect/" odd.y4m >wide.y4m
    check "pixels of $aspect" fails "times as wide as high" weft page wide.y4m --preview wide.png
done
noise wide.y4m 640 480 1 It 422
sed -i '1s/A1:1/A30:1/' wide.y4m
check "a picture that memory does not hold" fails "max-memory" weft page wide.y4m --max-memory 50M --preview wide.png
check "leaves nothing" test ! -e wide.png
finish
