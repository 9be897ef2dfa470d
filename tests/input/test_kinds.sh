#!/bin/bash
# Files that are no pictures and no video: what they are is told, and what helps is a command that works.
. "$WEFT_SOURCE/tests/program/script.sh"
. "$WEFT_SOURCE/tests/input/pictures.sh"
not_sanitized "tests/fuzz reads files of any kind"
needs python3 oiiotool

# tells WORDS FILE: convert and info both refuse the file with these words, in one line.
tells()
{
    fails "$1" weft convert "$2" "${raster[@]}" -o no.y4m && [ "$(wc -l <said)" = 1 ] && fails "$1" weft info "$2"
}

# ---- By how they begin ----

python3 - <<'FILES'
files = {'a.psd': b'8BPS\0\1', 'a.blend': b'BLENDER-v304', 'a.ma': b'//Maya ASCII 2023 scene', 'a.zip': b'PK\3\4\0\0',
         'a.pdf': b'%PDF-1.7', 'a.heic': b'\0\0\0\x18ftypheic', 'a.avif': b'\0\0\0\x1cftypavif', 'a.jp2': b'\0\0\0\x0cjP  \r\n\x87\n',
         'a.jxl': b'\xff\x0a\0', 'a.ktx': b'\xabKTX 11\xbb', 'a.dng': b'II*\0\x08\0\0\0', 'a.cr2': b'II*\0\x10\0\0\0CR\2\0',
         'a.wav': b'RIFF\x24\0\0\0WAVEfmt ', 'a.gz': b'\x1f\x8b\x08', 'zeros.mov': b'', 'zeros.exr': b''}
for name, head in files.items():
    open(name, 'wb').write(head + b'\0' * 600)
open('a.txt', 'w').write('Hello, world.\n')
open('text.exr', 'w').write('Not found.\n')
open('text.png', 'w').write('<html></html>\n')
open('s.lua', 'w').write('camera{}\n')
FILES
while read -r file words; do
    check "$file" tells "$words" "$file"
done <<'TABLE'
a.psd Photoshop document
a.blend a Blender scene, which weft does not read; render subframes
a.ma a Maya scene
a.zip a ZIP archive
a.pdf a PDF document
a.heic a HEIC picture
a.avif an AVIF picture
a.jp2 a JPEG 2000 picture
a.jxl a JPEG XL picture
a.ktx a KTX texture
a.dng a raw picture of a camera
a.cr2 a raw picture of a camera
a.wav sound (WAV)
a.gz packed by gzip
a.txt it is text
text.exr it is text
text.png it is text
s.lua weft render
zeros.mov nothing but zeros
zeros.exr nothing but zeros
TABLE

# ---- What helps ----

# helps FILE: the command of the message makes a file of which convert makes the color of c.tif.
helps()
{
    local command made
    exits 1 weft convert "$1" "${raster[@]}" -o no.y4m
    command=$(grep -o "'[^']* OUT[.a-z]*'" said | tr -d "'")
    [ -n "$command" ] || { cat said; return 1; }
    made=made.${command##*OUT.}
    command=${command/IN/$1}
    # shellcheck disable=SC2086
    ${command/OUT.*/$made} >/dev/null 2>&1 || { echo "failed: $command"; return 1; }
    exits 0 weft convert "$made" "${raster[@]}" -o out.####.exr || return 1
    python3 -c "
import sys; got = list(map(float, sys.argv[1].split()))
sys.exit(max(abs(g - s) for g, s in zip(got, (.6038, .1329, .0331))) > .012 or bool(len(got) != 3))" \
        "$(oiiotool --stats out.0000.exr | awk '/Stats Avg/ { print $3, $4, $5 }')"
}
for kind in bmp ppm sgi iff heic; do
    picture "c.$kind" .8,.4,.2 -d uint8 >/dev/null 2>&1 || { skip_part "oiiotool does not write $kind"; continue; }
    check "a command for $kind" helps "c.$kind"
done
if has ffmpeg && ffmpeg -v error -i c.bmp -pix_fmt rgb24 c.jp2; then check "a command for JPEG 2000" helps c.jp2; fi

# ---- Names and places ----

printf '\x89PNG\r\n\x1a\n' >"$(printf 'line\nbreak.png')"
check "a line break in a name" fails 'line?break.png' weft convert "$(printf 'line\nbreak.png')" "${raster[@]}" -o no.y4m
png real.png 128
cp real.png real.mov
check "a picture that is called video is one" luma 526 0 real.mov
cp real.png real.exr
check "a picture that is called EXR" fails "another format" weft convert real.exr "${raster[@]}" -o no.y4m
ln -s loop.png loop.png
check "links in a circle" fails "symbolic links" weft convert loop.png "${raster[@]}" -o no.y4m
mkdir videos empty places places/inner && touch videos/a.mov videos/b.mov videos/c.txt
check "a directory of videos" fails "2 .mov, 1 .txt" weft convert videos "${raster[@]}" -o no.y4m
check "an empty one" fails "no files at all" weft convert empty "${raster[@]}" -o no.y4m
check "one of directories" fails "no files at all" weft convert places "${raster[@]}" -o no.y4m
check "nothing was written" test ! -e no.y4m
finish
