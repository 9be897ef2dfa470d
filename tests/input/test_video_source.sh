#!/bin/bash
# Video as a source: rates, pipes, chunks, what is refused and what is damaged.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "test_jobs.sh converts"

. "$WEFT_SOURCE/tests/input/gray_video.sh"

# ---- Light before the aperture ----

check "black and white in turn" exits 0 weft convert turns.y4m $box -o o.y4m
check "are half the light" first_code o.y4m 720 25
check "a pipe" exits 0 bash -c "cat turns.y4m | '$WEFT' convert - $box -o p.y4m"
check "is the same" cmp o.y4m p.y4m
check "a named pipe" exits 0 weft convert <(cat turns.y4m) $box -o p.y4m
check "is the same" cmp o.y4m p.y4m
for chunk in 1/3 2/3 3/3; do weft convert turns.y4m $box --chunk $chunk -o c${chunk%/3}.y4m; done
check "chunks are the whole" cmp <(cat c1.y4m c2.y4m c3.y4m) o.y4m
check "some pictures" exits 0 weft convert turns.y4m $box --frames 20-59 -o f.y4m
check "are fewer frames" first_code f.y4m 720 10
check "every second one" exits 0 weft convert turns.y4m $box --frames 0-99x2 -o f.y4m
check "is black" first_code f.y4m 64 25
check "some frames" exits 0 weft convert turns.y4m $box --output-frames 5-9 -o f.y4m
check "of a pipe" bash -c "cat turns.y4m | '$WEFT' convert - $box --output-frames 5-9 -o p.y4m"
check "are the same" cmp f.y4m p.y4m
check "more than a pipe has" fails "ends after 25 frames" weft convert <(cat turns.y4m) $box --output-frames 20-29 -o no.y4m
check "some of a pipe" exits 0 weft convert - $box --frames 20-59 -o p.y4m <turns.y4m
check "are the same" exits 0 weft convert turns.y4m $box --frames 20-59 -o f.y4m
check "as of a file" cmp f.y4m p.y4m
check "a dry run" exits 0 weft convert turns.y4m $box --dry-run -o new.y4m --report -
check "counts" value "d['plan']['frames'] == 25 and d['input']['listed'] == 100"
check "untagged" exits 0 weft convert turns.y4m --raster 64x32@25i --overwrite -o o2.y4m
check "is told" says "rec601-525 (BT.1886, narrow range)"
check "the report" exits 0 weft convert turns.y4m $box -o o2.y4m --report -
check "says what was taken" value "d['input']['space'] == {'value': 'rec601-525', 'reason': 'default'} and
    d['input']['transfer'] == {'value': 'BT.1886', 'reason': 'default'} and
    d['input']['rate'] == {'value': '100', 'reason': 'file'}"
check "another space" exits 0 weft convert turns.y4m $box --from lin_rec709 -o f.y4m
check "is light already" first_code f.y4m 720 25
check "sRGB" exits 0 weft convert turns.y4m $box --from sRGB -o f.y4m --report -
check "is an option" value "d['input']['space'] == {'value': 'sRGB', 'reason': 'option'} and
    d['input']['transfer'] == {'value': 'sRGB', 'reason': 'option'}"
check "a space that there is not" exits 2 weft convert turns.y4m $box --from nowhere -o f.####.exr
for option in layer part; do
    check "--$option" exits 2 weft convert turns.y4m $box --$option 1 -o no.y4m
    check "is for EXR" says "turns.y4m: --$option chooses"
done
check "an output of no kind" exits 2 weft convert turns.y4m -o no.foo
check "a codec of another container" exits 2 weft convert turns.y4m --codec prores -o no.mxf
check "info" exits 0 weft info turns.y4m --json
check "says what is taken" value "d['files'][0]['input']['space']['value'] == 'rec601-525' and
    d['files'][0]['input']['rate']['value'] == '100'"
check "few pictures" exits 0 weft convert turns.y4m --raster 64x32@60i --overwrite -o o2.y4m
check "are warned of" says "fields repeat"
check "a rate of one's own" exits 0 weft convert turns.y4m $box --subframe-rate 200 -o f.y4m
check "is taken" first_code f.y4m 720 12

# ---- Identity ----

# Codes of all kinds, below black, above white and out of gamut, come back as they were.
identity()
{
    local bits=$1
    python3 - "$bits" <<'P'
import random, sys
bits = int(sys.argv[1])
random.seed(bits)
with open("any.y4m", "wb") as f:
    f.write(b"YUV4MPEG2 W16 H720 F25:1 Ip A1:1 C444%s\n" % (b"" if bits == 8 else b"p%d" % bits))
    f.write(b"FRAME\n" + b"".join(random.randint(1 << bits - 8, (255 << bits - 8) - 1).to_bytes((bits + 7) // 8, "little")
                                  for _ in range(3 * 16 * 720)))
P
    weft convert any.y4m --raster 16x720@25p --aperture line --temporal-width 0 --chroma 444 --dither none --bits "$bits" \
        -q --overwrite -o again.y4m
    python3 - "$bits" <<'P'
import sys
size = (int(sys.argv[1]) + 7) // 8
def codes(name):
    data = open(name, "rb").read()
    data = data[data.index(b"FRAME\n") + 6:]
    return [int.from_bytes(data[i:i + size], "little") for i in range(0, len(data), size)]
a, b = codes("any.y4m"), codes("again.y4m")
worst = max(abs(x - y) for x, y in zip(a, b))
if len(a) != len(b) or worst > 1: sys.exit("%d codes, %d, off by %d" % (len(a), len(b), worst))
P
}
for bits in 8 10 12 16; do check "$bits bits are what they were" identity $bits; done

# ---- Containers ----

if has_libav && has ffmpeg; then
    coded() { quiet_ffmpeg -i turns.y4m "${@:2}" "$1"; }
    coded turns.mkv -c:v ffv1
    coded turns.mov -c:v ffv1 -color_primaries bt709 -color_trc bt709 -colorspace bt709 -color_range tv
    for file in turns.mkv turns.mov; do
        check "$file" exits 0 weft convert $file $box -o o3.y4m
        check "its light" first_code o3.y4m 720 25
    done
    check "a tagged file" exits 0 weft convert turns.mov --raster 64x32@25i --overwrite -o o3.y4m
    check "is not told of" [ -z "$(grep tagged said)" ]
    check "a pipe of a container" bash -c "cat turns.mkv | '$WEFT' convert - $box -o p.y4m"
    check "is the same" cmp o.y4m p.y4m
    # Milliseconds do not tell 240000/1001.
    y4m fast.y4m "W64 H32 F240000:1001 Ip A1:1 C444p10" 60 64 940
    quiet_ffmpeg -i fast.y4m -c:v ffv1 fast.mkv
    check "milliseconds" exits 0 weft convert fast.mkv ${box/25i/30000\/1001i} -o m.y4m
    check "the rate itself" exits 0 weft convert fast.y4m ${box/25i/30000\/1001i} -o y.y4m
    check "are one" cmp m.y4m y.y4m
    check "it replaces itself" exits 2 weft convert turns.mkv --raster 64x32@25i --overwrite -o turns.mkv
    check "which is said" says "would replace an input"
    check "a pipe of a container that is cut off" fails "before what it says is its end" \
        weft convert <(head -c 3000 turns.mkv) $box -o no.y4m
    head -c $(($(stat -c %s turns.mkv) / 2)) turns.mkv >cut.mkv
    check "cut off" exits 1 weft convert cut.mkv $box -o no.y4m
    check "nothing is left" [ ! -e no.y4m ]
fi

# ---- What is refused ----

y4m mixed.y4m "W64 H32 F100:1 Im A1:1 C444p10" 40 64
check "Y4M of which some frames are fields" exits 2 weft convert mixed.y4m $box -o no.y4m
check "is refused too" says "--input-scan progressive"
y4m fields.y4m "W64 H32 F25:1 It A1:1 C444p10" 4 64
check "interlaced" refuses "bwdif" convert fields.y4m $box -o no.y4m
check "though wrongly tagged" exits 0 weft convert fields.y4m $box --input-scan progressive -o o4.y4m
check "two" refuses "one file is taken at a time" convert turns.y4m fields.y4m $box -o no.y4m
refuses_pipe() { exits 2 weft convert <(cat turns.y4m) $box "$@" -o no.y4m && says "${1#--}" && says "at its end only"; }
check "a chunk of a pipe" refuses_pipe --chunk 1/2
check "a dry run of a pipe" refuses_pipe --dry-run
check "more than there are" exits 2 weft convert turns.y4m $box --frames 50-100 -o no.y4m
check "which is said" says "0 to 99"
check "its own input" exits 2 weft convert turns.y4m $box -o turns.y4m
check "is not replaced" says "would replace an input"

# ---- What is damaged ----

head -c 100000 turns.y4m >cut.y4m
check "a picture that is cut off" fails "within frame 8" weft convert cut.y4m $box -o no.y4m
check "and when" says "0.080 s"
check "a pipe that is cut off" fails "within frame 8" weft convert - $box -o no.y4m <cut.y4m
check "and when" says "0.080 s"
{ cat turns.y4m; echo FRAMF; cat turns.y4m; } >junk.y4m
check "no FRAME" fails "frame 100" weft convert - $box -o no.y4m <junk.y4m
check "an absurd rate" bash -c "sed '1s/F100:1/F1000000000:1/' turns.y4m >fast2.y4m"
check "is refused" fails "cannot be" weft convert fast2.y4m $box -o no.y4m
check "no rate" bash -c "sed '1s/F100:1/F0:0/' turns.y4m >none.y4m"
check "is refused" exits 1 weft convert none.y4m $box -o no.y4m
y4m one.y4m "W64 H32 F100:1 Ip A1:1 C444p10" 1 64
check "one picture" fails "do not fill one frame" weft convert one.y4m $box -o no.y4m
check "one of a pipe" fails "do not fill one frame" weft convert - $box -o no.y4m <one.y4m
check "nothing is left" [ ! -e no.y4m ]

finish
