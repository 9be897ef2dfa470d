#!/bin/bash
# Alpha of video: color is multiplied by it, it goes through the aperture, lies over --background or is written.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "test_key.sh has alpha"
needs_libav
needs ffmpeg python3 oiiotool

source="testsrc2=s=64x32:r=50:d=0.2,format=rgba,geq=r='r(X,Y)':g='g(X,Y)':b='b(X,Y)':a='X*4'"
# coded NAME OPTION..: five pictures whose alpha grows from left to right.
coded() { quiet_ffmpeg -f lavfi -i "$source" "${@:2}" "$1"; }
light="--raster 64x32@50p --aperture box --from rec709 --overwrite"
made() { exits 0 weft convert "$1" $light "${@:3}" -q -o "$2.####.exr"; }

# over TOLERANCE FILE: alpha of a is 4 x / 255; with the color of i, which ignored it, a is A i, and o is that over .5.
over()
{
    python3 - "$@" <<'P'
import re, subprocess, sys
def pixels(name):
    text = subprocess.run(["oiiotool", "--dumpdata", name + ".0002.exr"], capture_output=True, text=True, check=True).stdout
    return [[float(v) for v in line.split()] for line in re.findall(r"Pixel[^:]*: ([-0-9.e ]+)", text)]
a, b, i, o = map(pixels, "abio") # b is of the first file
worst = 0
for n in range(64 * 32):
    alpha = a[n][3]
    if abs(alpha - n % 64 * 4 / 255) > float(sys.argv[1]): sys.exit("alpha of pixel %d is %g" % (n, alpha))
    for c in range(3):
        worst = max(worst, abs(a[n][c] - alpha * i[n][c]), abs(b[n][c] - a[n][c]) if sys.argv[2] == "png.mov" else 0, abs(o[n][c] - a[n][c] - (1 - alpha) / 2))
if worst > 1e-6: sys.exit("it is off by %g" % worst)
P
}
for row in "png.mov rgba png" "rle.mov argb qtrle" "f.mkv yuva420p ffv1" "deep.mov rgba64be png" "gray.mov ya8 png" \
    "planes.mkv gbrap12le ffv1" "all.y4m yuva444p wrapped_avframe" "turns.apng rgba apng" "p.mov yuva444p10le prores_ks" \
    "v9.webm yuva420p libvpx-vp9"; do
    # shellcheck disable=SC2086
    set -- $row
    ffmpeg -v error -encoders | grep -q " ${3} " || { skip_part "no $3"; continue; }
    options=
    [ $3 = prores_ks ] && options="-profile:v 4444 -alpha_bits 16"
    [ $3 = libvpx-vp9 ] && options="-lossless 1"
    check "$1 is made" coded "$1" -pix_fmt $2 -c:v $3 $options -strict -1
    check "with alpha" made "$1" a --alpha-out
    [ $1 = png.mov ] && check "over black" made "$1" b
    check "over gray" made "$1" o --background .5,.5,.5
    check "without" made "$1" i --alpha ignore
    check "all of $1 are right" over .004 "$1"
    check "info tells" eval 'exits 0 weft info ${row%% *} && prints "alpha             straight (default)"'
done

# ---- How color lies beside it ----

# Light of 1 whose codes were multiplied by alpha comes out as alpha; code 128 at alpha 128 of 255 is white.
quiet_ffmpeg -f lavfi -i "color=black:s=64x32:r=50:d=0.1,format=rgba,geq=r='4*X':g='4*X':b='4*X':a='4*X'" -c:v png pre.mov
check "premultiplied" exits 0 weft convert pre.mov $light --alpha premultiplied --alpha-out -o a.####.exr --report -
check "is told" value "d['input']['alpha'] == {'value': 'premultiplied', 'reason': 'option'}"
check "and taken as such" eval 'oiiotool --dumpdata a.0000.exr | python3 -c "
import re, sys
for line in re.findall(r\"Pixel[^:]*: ([-0-9.e ]+)\", sys.stdin.read()):
    v = [float(x) for x in line.split()]
    assert max(abs(x - v[3]) for x in v) < 1e-6, v"'
if ffmpeg -v error -encoders | grep -q prores_ks; then
    for fill in premultiplied straight; do
        check "QuickTime of $fill fill" exits 0 weft convert png.mov $light --alpha-out --fill $fill --codec prores-4444 -o own.mov
        check "says so" eval 'exits 0 weft info own.mov && prints "alpha             $fill (file)"'
    done
fi
check "video without" exits 0 weft convert own.mov $light --alpha ignore -o o.####.exr --report -
check "it is told" value "d['input']['alpha'] == {'value': 'ignore', 'reason': 'option'}"

# ---- In chunks, by a pipe, and where a picture is missing ----

check "a whole run" exits 0 weft convert f.mkv $light -q --background .5,.5,.5 -o w.y4m
for c in 1 2; do weft convert f.mkv $light -q --background .5,.5,.5 --chunk $c/2 -o w$c.y4m; done
check "is its chunks" eval 'cat w1.y4m w2.y4m | cmp - w.y4m'
check "a pipe" exits 0 weft convert <(cat f.mkv) $light -q --background .5,.5,.5 -o p.y4m
check "is the same" cmp w.y4m p.y4m
check "more threads" exits 0 weft convert f.mkv $light -q --background .5,.5,.5 --threads 3 -o p.y4m
check "change nothing" cmp w.y4m p.y4m
finish
