#!/bin/bash
# weft composite as its users run it: bars through every coder and decoder, labels kept, what is
# refused and how, nothing half written.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "test_jobs.sh composites"

needs python3

# refused TEXT ARGUMENT..: status 2, a message with the text, no file.
refused()
{
    local text=$1
    shift
    exits 2 "$WEFT" composite "$@" && says "$text" && [ ! -e no.y4m ]
}

# ---- Video to try: 4:2:2 of 8 bits ----

cat >tool.py <<'END'
import sys

WIDTH = 720
BARS = [(r, g, b) for g in (.75, 0) for r in (.75, 0) for b in (.75, 0)]

def color(r, g, b):
    y = .299 * r + .587 * g + .114 * b
    return (int(16.5 + 219 * y), int(128.5 + 224 * (b - y) / 1.772), int(128.5 + 224 * (r - y) / 1.402))

def bars(x):
    return color(*BARS[x // 90])

# upright stripes of luma, two samples each: 3.375 MHz
def stripes(x):
    return (180 if x // 2 % 2 else 60, 128, 128)

def make(path, lines, rate, letter, frames, what):
    luma = bytes(what(x)[0] for x in range(WIDTH))
    cb, cr = (bytes(what(x)[p] for x in range(0, WIDTH, 2)) for p in (1, 2))
    with open(path, 'wb') as out:
        out.write(b'YUV4MPEG2 W720 H%d F%s I%s A10:11 C422\n' % (lines, rate.encode(), letter.encode()))
        for _ in range(frames):
            out.write(b'FRAME\n' + luma * lines + cb * lines + cr * lines)

def frames(path):
    data = open(path, 'rb').read()
    head, rest = data.split(b'\n', 1)
    lines = int(head.split(b' H')[1].split()[0])
    size = 6 + WIDTH * lines * 2
    assert len(rest) % size == 0, 'not whole frames'
    return lines, [rest[i + 6:i + size] for i in range(0, len(rest), size)]

# Codes within 1 % of the bars 30 samples from every edge, of every line and plane.
def near(path):
    lines, all_frames = frames(path)
    worst = 0
    for f in all_frames:
        for line in range(0, lines, 5):
            for bar in range(8):
                want = color(*BARS[bar])
                for x in (90 * bar + 30, 90 * bar + 44, 90 * bar + 58):
                    at = WIDTH * lines
                    got = (f[line * WIDTH + x], f[at + line * 360 + x // 2],
                           f[at + at // 2 + line * 360 + x // 2])
                    worst = max(worst, *(abs(a - b) for a, b in zip(want, got)))
    assert worst <= 2, 'a bar is off by %d codes' % worst

# Which frames equal frame 0: "0 2" of NTSC.
def repeats(path):
    all_frames = frames(path)[1]
    print(*(i for i, f in enumerate(all_frames) if f == all_frames[0]))

# How far chroma is from gray at most.
def chroma(path):
    lines, all_frames = frames(path)
    print(max(abs(c - 128) for f in all_frames for line in range(lines)
              for p in (0, 1)
              for c in f[(2 + p) * WIDTH // 2 * lines + line * 360 + 30:][:300]))

command, *rest = sys.argv[1:]
if command == 'make':
    path, lines, rate, letter, count, what = rest
    make(path, int(lines), rate, letter, int(count), globals()[what])
else:
    globals()[command](*rest)
END
tool() { python3 tool.py "$@"; }

tool make 525.y4m 486 30000:1001 b 2 bars
tool make 625.y4m 576 25:1 t 2 bars

# ---- Bars ----

for lines in 525 625; do
    for encoder in cheap filtered; do
        for decoder in notch comb2 comb3; do
            name=$lines-$encoder-$decoder.y4m
            check "$name is made" exits 0 "$WEFT" composite $lines.y4m -o $name --bits 8 \
                --encoder $encoder --decoder $decoder
            check "$name has its bars" tool near $name
        done
    done
done
check "cheap and notch are what is taken" exits 0 "$WEFT" composite 525.y4m -o plain.y4m --bits 8
check "they are the same bytes" cmp plain.y4m 525-cheap-notch.y4m
check "the system can be named" exits 0 "$WEFT" composite 625.y4m --system pal -o pal.y4m --bits 8
check "pal is 625 lines' system" cmp pal.y4m 625-cheap-notch.y4m
check "from a pipe to a pipe" cmp plain.y4m \
    <("$WEFT" composite - -o - --bits 8 <525.y4m)

# ---- False color, and how it shimmers ----

tool make s525.y4m 486 30000:1001 b 5 stripes
tool make s625.y4m 576 25:1 t 5 stripes
for lines in 525 625; do
    check "stripes of $lines" exits 0 "$WEFT" composite s$lines.y4m -o shown.y4m --bits 8 --overwrite
    check "stripes have false color" [ "$(tool chroma shown.y4m)" -gt 20 ]
    [ $lines = 525 ] && sequence="0 2 4" || sequence="0 4"
    check "the color sequence of $lines" same "$(tool repeats shown.y4m)" "$sequence"
    check "a comb" exits 0 "$WEFT" composite s$lines.y4m -o shown.y4m --bits 8 --overwrite \
        --decoder comb3
    check "a comb takes it away" [ "$(tool chroma shown.y4m)" -le 1 ]
done
check "a filter" exits 0 "$WEFT" composite s525.y4m -o shown.y4m --bits 8 --overwrite \
    --encoder filtered
check "a filter takes it away" [ "$(tool chroma shown.y4m)" -le 1 ]

# ---- Labels ----

# label FILE WORD..: the first line has the words.
label()
{
    local file=$1 word
    shift
    for word; do
        head -n 1 "$file" | grep -qF " $word" || { head -n 1 "$file"; return 1; }
    done
}
for kind in "486 30000:1001 b" "486 30000:1001 t" "480 30000:1001 b" "480 30000:1001 t" \
    "576 25:1 t" "576 25:1 b" "486 30000:1001 p" "576 25:1 p"; do
    set -- $kind
    rm -f in.y4m out.y4m
    tool make in.y4m "$1" "$2" "$3" 1 bars
    check "$kind" exits 0 "$WEFT" composite in.y4m -o out.y4m
    check "$kind keeps its label" label out.y4m W720 H$1 F$2 I$3 A10:11 C422p10
    check "$kind says nothing" [ ! -s said ]
done
sed '1s/A10:11/A40:33/' 525.y4m >wide.y4m
check "wide" exits 0 "$WEFT" composite wide.y4m -o out.y4m --overwrite
check "wide stays wide" label out.y4m A40:33

# ---- Other forms ----

check "v210" exits 0 "$WEFT" composite 525.y4m -o out.v210
check "v210 is read" exits 0 "$WEFT" composite out.v210 --raster 525i -o twice.y4m
for kind in png tif dpx; do
    has_module oiio || { skip_part "$kind is written and read: weft was built without OpenImageIO"; continue; }
    check "$kind" exits 0 "$WEFT" composite 525.y4m -o "out.####.$kind"
    check "$kind has two files" [ -s out.0000.$kind -a -s out.0001.$kind -a ! -e out.0002.$kind ]
    check "$kind is read" exits 0 "$WEFT" composite "out.####.$kind" -o $kind.y4m
done

# ---- What is refused ----

check "no input" refused "nothing to show" -o no.y4m
check "no output" refused "nowhere to write" 525.y4m
check "two inputs" refused "one input at a time" 525.y4m 625.y4m -o no.y4m
check "an unknown option" refused "did you mean --encoder" 525.y4m --encodr cheap -o no.y4m
check "an unknown decoder" refused "notch|comb2|comb3" 525.y4m --decoder comb -o no.y4m
check "an unknown system" refused "ntsc|pal" 525.y4m --system secam -o no.y4m
check "the other system" refused "pal has 625" 525.y4m --system pal -o no.y4m
check "EXR" refused "finished video" 525.y4m -o no.####.exr
check "a kind of output that there is not" refused "" 525.y4m -o no.txt
printf 'YUV4MPEG2 W320 H240 F25:1 It C422\nFRAME\n' >small.y4m
head -c 153600 /dev/zero >>small.y4m
check "a raster without a map" refused "525i, 525i-imx, 525i-dv, 525i-rp202, 625i, 625i-dv" \
    small.y4m -o no.y4m
check "a raster of another size" refused "leave --raster out" 525.y4m --raster 1080i50 -o no.y4m
printf 'YUV4MPEG2 W1920 H1080 F25:1 It C422\n' >hd.y4m
check "HD" refused "cannot carry" hd.y4m -o no.y4m
check "its own input" refused "would replace an input" 525.y4m -o 525.y4m --overwrite
check "an output that is there" exits 1 "$WEFT" composite 525.y4m -o plain.y4m
check "it says how to replace it" grep -q -e --overwrite said
check "it is as it was" cmp plain.y4m 525-cheap-notch.y4m

# ---- Nothing half written ----

mkdir left
head -c 1000000 525.y4m >cut.y4m
check "a file that is cut off" exits 1 "$WEFT" composite cut.y4m -o left/cut.y4m
check "the frame is named" grep -q "frame 1" said
check "a header alone" exits 1 "$WEFT" composite <(head -n 1 525.y4m) -o left/none.y4m
check "an input that is not there" exits 1 "$WEFT" composite nowhere.y4m -o left/none.y4m
check "nothing is left of them" [ -z "$(ls -A left)" ]
check "a full device" exits 1 bash -c "'$WEFT' composite 525.y4m -o - >/dev/full"

# An input that goes on for ever.
endless() { cat 525.y4m; while tail -n +2 525.y4m; do :; done; }
stopped() { interrupted "$1" "$2" 0.5 "$WEFT" composite - -o left/long.y4m < <(endless 2>/dev/null); }
check "SIGINT" stopped INT 130
check "SIGTERM" stopped TERM 143

check "help teaches" grep -q "cross-color" <("$WEFT" composite --help)
check "weft lists it" grep -q "composite *IN -o OUTPUT" <("$WEFT" --help)

finish
