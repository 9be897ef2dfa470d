#!/bin/bash
# Fill and key as two outputs: the codes of both, their order and timecode, and that both are there or neither.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "test_jobs.sh writes a key"
needs_libav
needs oiiotool python3 ffmpeg ffprobe
. "$WEFT_SOURCE/tests/key/shot.sh"

# key_codes RAW LAW: luma of 10 bits, 4:2:2, whose codes are those of K within half of one, chroma neutral.
key_codes()
{
    PYTHONPATH=$WEFT_SOURCE/tests/key python3 -B - "$1" "$2" <<'END'
import struct, sys
from laws import PLACES, fill_and_key
raw = open(sys.argv[1], "rb").read()
raw = struct.unpack(f"<{len(raw) // 2}H", raw)
assert len(raw) == 2 * 96 * 64, len(raw)
assert set(raw[96 * 64 :]) == {512} and min(raw) >= 64 and max(raw) <= 940
for name, (x, y, light, alpha) in PLACES.items():
    want, have = 64 + 876 * fill_and_key(light, alpha, sys.argv[2], False)[1], raw[96 * y + x]
    assert abs(want - have) < .51 + .876 * (sys.argv[2] == "encoded"), (name, have, want)  # K is tried in steps of .001
END
}
decoded() { ffmpeg -nostdin -v error -y -i "$1" -frames:v 1 -f rawvideo -pix_fmt "$2" "$3"; }

# ---- Codes ----

check "fill and key" made_of -o fill.mkv --key key.mkv --report r.json --chroma box
check "the key is the law's" eval "decoded key.mkv yuv422p10le key.raw && key_codes key.raw encoded"
check "the report tells of both" python3 -c "
import json
raise SystemExit(json.load(open('r.json'))['alpha'] != {'fill': 'premultiplied', 'law': 'encoded', 'clipped_share': 0, 'key': 'ffv1'})"
check "and with alpha beside it" made_of -o both.mkv --alpha-out --key key2.mkv --chroma box
check "the fill is the same" eval "decoded fill.mkv yuv422p10le a.raw && decoded both.mkv yuv422p10le b.raw && cmp a.raw b.raw"
check "and so is the key" cmp key.mkv key2.mkv
check "by the law of light" made_of -o fill.y4m --key key.y4m --key-law light
check "the key is alpha" eval "decoded key.y4m yuv422p10le key.raw && key_codes key.raw light"
check "a straight fill" made_of -o straight.y4m --key key2.y4m --key-law light --fill straight
check "has the same key" cmp key.y4m key2.y4m
check "and another fill" eval "! cmp -s fill.y4m straight.y4m"
for key in key.mov key.v210 hash:key.txt key.####.tif; do
    check "a key in $key" made_of -o fill.y4m --key "$key"
done
check "v210 has the codes of FFV1" eval "decoded key.mov yuv422p10le a.raw && decoded key.mkv yuv422p10le b.raw && cmp a.raw b.raw"
check "pictures" made_of -o fill.####.dpx --key key.####.png
check "are gray of full range" eval "oiiotool key.0000.png --cut 1x1+84+34 --printstats | grep -q 'Stats Avg: 0.574[0-9]* 0.574[0-9]* 0.574'"
check "light" made_of -o fill.####.exr --key key.####.exr
check "has alpha as it is" eval "oiiotool key.0000.exr --cut 1x1+84+34 --printstats | grep -q 'Stats Avg: 0.500000 0.500000 0.500000'"
check "beside color without it" eval "oiiotool fill.0000.exr --cut 1x1+84+34 --printstats | grep -q 'Stats Avg: 0.250000 0.125000 0.050000 (float)'"

# ---- Order and timecode ----

fields=(convert shot --subframe-rate 48 --raster 96x64@24i,bff --aperture line --temporal-width 0 -q)
check "fields" exits 0 weft "${fields[@]}" --timecode 01:02:03:04 -o fill.mov --codec prores --key keys.mov
for file in fill.mov keys.mov; do
    check "$file is ProRes, bottom first, with timecode" eval "ffprobe -v error -show_entries stream=codec_name,field_order:stream_tags=timecode \
        -of csv=p=0 $file | tr '\n' ' ' | grep -q 'prores,bt,01:02:03:04'"
    check "of as many frames" [ "$(ffprobe -v error -count_packets -select_streams v -show_entries stream=nb_read_packets -of csv=p=0 $file | tr -dc 0-9)" = 4 ]
done

# ---- Both or neither ----

rm -f key.* fill.*
touch key.y4m
check "a key that exists" exits 1 weft "${fields[@]}" -o fill.y4m --key key.y4m
check "leaves no fill" [ ! -e fill.y4m ]
check "a key in no folder" exits 1 weft "${fields[@]}" -o fill.y4m --key none/key.y4m
check "leaves no fill, either" [ ! -e fill.y4m ]
rm key.y4m
touch fill.y4m
check "a fill that exists" exits 1 weft "${fields[@]}" -o fill.y4m --key key.y4m
check "leaves no key" [ ! -e key.y4m ]
# The fill's name is taken while it is written, so that it fails when the key has its name already.
rm fill.y4m
mkfifo pipe
weft convert shot --subframe-rate 48 --raster 96x64@24p -q -o video.y4m
"$WEFT" convert pipe --raster 96x64@24p -q -o fill.y4m --key key.y4m 2>late &
exec 8>pipe
head -c 40000 video.y4m >&8
for _ in $(seq 200); do
    [ "$(find /proc/$!/fd -lname "$PWD/*" 2>/dev/null | wc -l)" -ge 2 ] && break
    sleep .05
done
touch fill.y4m
tail -c +40001 video.y4m >&8
exec 8>&-
wait $!
check "a fill that fails at the end" [ $? = 1 ]
check "for that reason" grep -q "fill.y4m" late
check "leaves no key" [ ! -e key.y4m ]
check "and nothing beside" [ ! -s fill.y4m ]

# ---- Resuming, chunks, what is there ----

check "sequences" exits 0 weft "${fields[@]}" -o f.####.tif --key k.####.png
cp k.0002.png whole.png
rm k.0002.png f.0001.tif
check "are gone on with" exits 0 weft "${fields[@]}" -o f.####.tif --key k.####.png --resume --report r.json
check "where one is missing" python3 -c "import json; raise SystemExit(json.load(open('r.json'))['frames'] != 2)"
check "with the same bytes" cmp k.0002.png whole.png
check "a whole" exits 0 weft "${fields[@]}" -o f.y4m --key k.y4m
check "is left as it is" exits 0 weft "${fields[@]}" -o f.y4m --key k.y4m --resume --report r.json
check "all of it" python3 -c "import json; raise SystemExit(json.load(open('r.json'))['frames'] != 0)"
rm k.y4m
check "or made again" exits 0 weft "${fields[@]}" -o f.y4m --key k.y4m --resume
for chunk in 1 2; do weft "${fields[@]}" -o f$chunk.y4m --key k$chunk.y4m --chunk $chunk/2; done
check "chunks of fills join" eval "cat f1.y4m f2.y4m | cmp - f.y4m"
check "and those of keys" eval "cat k1.y4m k2.y4m | cmp - k.y4m"
check "a dry run" exits 0 weft "${fields[@]/-q/--dry-run}" -o f.y4m --key new.####.dpx
check "tells of the fill" prints "output: Y4M, 1 there already (refused)"
check "and of the key" prints "key: DPX, 0 there already (new)"
check "with its names" prints "files: new.0000.dpx .. new.0003.dpx (4)"

# ---- What is refused ----

# refused TEXT OPTION..
refused()
{
    local word=$1
    shift
    exits 2 weft "${fields[@]}" "$@" && says "$word"
}
check "one name" refused "would be one file" -o no.y4m --key ./no.y4m
check "one sequence" refused "would be one file" -o no.####.png --key ./no.%04d.png
check "a key of no kind" refused "the name of an output" -o no.y4m --key no.doc
check "fields apart and a video" refused "holds frames" -o no.####.png --key no.y4m --fields separate
check "resuming unlike things" refused "both are sequences" -o no.####.png --key no.y4m --resume
check "a chunk of a container" refused "cannot be joined" -o no.y4m --key no.mov --chunk 1/2
check "a background" refused "--background fills it" -o no.y4m --key no2.y4m --background 1,1,1
check "a law of codes for light" refused "holds light" -o no.####.exr --key no.y4m --key-law encoded
check "samples" exits 2 weft trace "$WEFT_SOURCE/examples/scenes/still.lua" --key no.y4m -o no.####.exr
check "an input" exits 2 weft "${fields[@]}" -o no.####.exr --key "shot/s.####.exr" --overwrite
check "nothing is left" eval "! ls no* 2>/dev/null"

finish
