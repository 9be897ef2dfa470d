#!/bin/bash
# Fill and key in video: alpha beside the picture, by ffmpeg's decoders and a search that shares nothing with weft.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "test_jobs.sh writes alpha"
needs_libav
needs oiiotool python3 ffmpeg ffprobe

. "$WEFT_SOURCE/tests/key/shot.sh"

# codes FILE PIXELS BITS LAW FILL TOLERANCE: color and alpha at the places are those of the law.
codes()
{
    ffmpeg -nostdin -v error -y -i "$1" -frames:v 1 -f rawvideo -pix_fmt "$2" codes.raw || return 1
    PYTHONPATH=$WEFT_SOURCE/tests/key python3 -B - "$2" "$3" "$4" "$5" "$6" <<'END'
import struct, sys
from laws import PLACES, fill_and_key, ycbcr
pixels, bits, law, fill, most = sys.argv[1], int(sys.argv[2]), sys.argv[3], sys.argv[4], float(sys.argv[5])
raw, deep = open("codes.raw", "rb").read(), bits > 8
raw = struct.unpack(f"<{len(raw) // 2}H", raw) if deep else raw
half = "422" in pixels
widths = [96, 48, 48, 96] if half else [96] * 4
starts = [64 * sum(widths[:p]) for p in range(4)]
assert len(raw) == 64 * sum(widths), len(raw)
wrong = []
for name, (x, y, light, alpha) in PLACES.items():
    f, k = fill_and_key(light, alpha, law, fill == "straight")
    want = [*ycbcr(f, bits), k * ((1 << bits) - 1)]
    have = [raw[starts[p] + y * widths[p] + (x // 2 if half and p in (1, 2) else x)] for p in range(4)]
    if any(abs(a - b) > most for a, b in zip(have, want)):
        wrong.append(f"{name}: {have}, not {[round(v, 1) for v in want]}")
sys.exit("\n".join(wrong) or 0)
END
}

# ---- Alpha beside video ----

check "ProRes 4444" made_of --alpha-out --codec prores-4444 -o p.mov --report p.json
check "is 4:4:4 with alpha" eval "ffprobe -v error -show_entries stream=codec_tag_string,pix_fmt -of csv=p=0 p.mov | grep -q 'ap4h,yuva444p1'"
check "holds the law of codes" codes p.mov yuva444p10le 10 encoded premultiplied 3
check "and the report says so" python3 -c "
import json
raise SystemExit(json.load(open('p.json'))['alpha'] != {'fill': 'premultiplied', 'law': 'encoded', 'clipped_share': 0})"
check "by the law of light" made_of --alpha-out --codec prores-4444 --key-law light -o l.mov
check "it holds that" codes l.mov yuva444p10le 10 light premultiplied 3
check "straight" made_of --alpha-out --codec prores-4444 --fill straight --key-law light -o s.mov
check "it is divided" codes s.mov yuva444p10le 10 light straight 3
# graphics FILE: the mode of its vmhd.
graphics() { python3 -c "d = open('$1', 'rb').read(); print(d[d.index(b'vmhd') + 8:][:2].hex())"; }
check "QuickTime says that color is multiplied" [ "$(graphics p.mov)" = 0102 ]
check "and that it is straight" [ "$(graphics s.mov)" = 0100 ]
check "without alpha" made_of --codec prores-4444 -o no.mov
check "it is 4:4:4, too" eval "ffprobe -v error -show_entries stream=pix_fmt -of csv=p=0 no.mov | grep -qx 'yuv444p1[02]le'"
check "and says nothing of alpha" [ "$(graphics no.mov)" = 0000 ]
for row in "8 yuva422p box" "8 yuva444p 444" "10 yuva422p10le box" "10 yuva444p10le 444" "16 yuva422p16le box" "16 yuva444p16le 444"; do
    read -r bits pixels chroma <<<"$row"
    most=.51
    [ "$bits" = 16 ] && most=20
    [ "$bits" = 10 ] && most=.6
    check "FFV1 of $bits bits, $chroma" made_of --alpha-out --bits "$bits" --chroma "$chroma" -o f.mkv
    check "is $pixels" eval "ffprobe -v error -show_entries stream=pix_fmt -of csv=p=0 f.mkv | grep -qx $pixels"
    check "and exact" codes f.mkv "$pixels" "$bits" encoded premultiplied $most
done
check "FFV1 by light, straight" made_of --alpha-out --fill straight --key-law light --chroma box -o f.mkv
check "is exact" codes f.mkv yuva422p10le 10 light straight .6
# Alpha as ffmpeg shows it alone, of fields: those of the frame that has none of interlacing.
check "fields" exits 0 weft convert shot --subframe-rate 192 --raster 96x64@24i,bff --aperture line --temporal-width 0 -q --alpha-out \
    --codec prores-4444 -o i.mov
check "have their alpha" eval "ffmpeg -nostdin -v error -y -i i.mov -vf alphaextract -frames:v 1 -f rawvideo -pix_fmt gray a.raw &&
    [ \"\$(od -An -tu1 -j \$((34 * 96 + 40)) -N1 a.raw | tr -d ' ')\" = 255 ] && [ \"\$(od -An -tu1 -j 0 -N1 a.raw | tr -d ' ')\" = 0 ]"

# ---- What is refused ----

# refused TEXT OPTION..
refused()
{
    local word=$1
    shift
    exits 2 weft convert shot --subframe-rate 192 --raster 96x64@24p "$@" && says "$word"
}
check "12 bits" refused "alpha of 8, 10 and 16 bits" --alpha-out --bits 12 -o no.mkv
check "a codec without alpha" refused "prores-4444" --alpha-out --codec prores -o no2.mov
check "the law of mixers for HLG" refused "take light" --alpha-out --key-law encoded --to rec2100-hlg -o no.mkv
check "which is by light" exits 0 weft convert shot --subframe-rate 192 --raster 96x64@24p --alpha-out --to rec2100-hlg -o hlg.mkv
check "and says so" says "law of light"
check "nothing is left" eval "! ls no.mkv no2.mov 2>/dev/null"

finish
