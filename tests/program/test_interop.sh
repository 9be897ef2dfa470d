#!/bin/bash
# What other programs make of the outputs: the same codes out of every container of them, and the
# fields, rates and timecodes that they were told. (tests/program/test_video.sh has Y4M's field order.)
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "test_jobs.sh writes every form"

convert() { "$WEFT" convert in/subframe.####.exr -q "$@" || { echo "weft convert $*"; return 1; }; }

# codes FORMAT FILE OPTION..: the sum of a file's samples in this pixel format.
codes()
{
    local format=$1 file=$2
    shift 2
    ffmpeg -nostdin -v error "$@" -i "$file" -pix_fmt "$format" -f rawvideo - | md5sum
}

# alike FORMAT FILE FILE OPTION..: the options are for the second file.
alike()
{
    local format=$1 one=$2 other=$3
    shift 3
    local a b
    a=$(codes "$format" "$one") b=$(codes "$format" "$other" "$@")
    [ "$a" = "$b" ] && [ "$a" != "$(md5sum </dev/null)" ] || { echo "$one and $other differ"; return 1; }
}

# upper BITS FILE: the upper bits of a picture's 16, as planes G B R of 16-bit words.
upper()
{
    ffmpeg -nostdin -v error -i "$2" -pix_fmt gbrp16le -f rawvideo - | python3 -c "
import array, sys
codes = array.array('H', sys.stdin.buffer.read())
sys.stdout.buffer.write(array.array('H', (c >> 16 - $1 for c in codes)).tobytes())"
}

unpacked_alike()
{
    local other
    other=$(upper "$1" "p$1.png" | md5sum)
    [ "$(codes "gbrp$1le" "p$1.0000.dpx")" = "$other" ] && [ "$other" != "$(md5sum </dev/null)" ]
}

subframes in 16

# ---- The same codes ----

if has ffmpeg; then
    # v210 at widths that 6 and 48 do not divide; Y4M is what it is held to.
    for width in 720 50 52 46 2; do
        raster=${width}x36@29.97i,bff
        check "Y4M $width" convert --raster "$raster" -o "$width.y4m"
        check "v210 $width" convert --raster "$raster" -o "$width.v210"
        check "uyvy $width" convert --raster "$raster" -o "$width.uyvy"
        check "8-bit Y4M $width" convert --raster "$raster" --bits 8 -o "$width-8.y4m"
        raw="-video_size ${width}x36 -framerate 30000/1001"
        # shellcheck disable=SC2086
        {
            check "v210 $width is the Y4M" alike yuv422p10le "$width.y4m" "$width.v210" -f v210 $raw
            check "uyvy $width is the Y4M" alike yuv422p "$width-8.y4m" "$width.uyvy" -f rawvideo $raw \
                -pixel_format uyvy422
        }
    done
    for bits in 8 16; do
        for kind in dpx tif png; do
            check "$kind, $bits bits" convert --bits $bits -o "p$bits.####.$kind"
        done
        format=$([ $bits = 8 ] && echo rgb24 || echo rgb48le)
        check "TIFF is PNG, $bits bits" alike "$format" p$bits.0000.png p$bits.0000.tif
        check "DPX is PNG, $bits bits" alike "$format" p$bits.0000.png p$bits.0000.dpx
    done
    # 10 and 12 bits: ffmpeg and OpenImageIO each unpack them in their own way. PNG has the codes in
    # its upper bits.
    if has oiiotool; then
        for bits in 10 12; do
            check "DPX, $bits bits" convert --bits $bits -o "p$bits.####.dpx"
            check "DPX read, $bits bits" oiiotool "p$bits.0000.dpx" -d uint16 -o "p$bits.png"
            check "$bits bits are the same" unpacked_alike $bits
        done
    fi
fi

# ---- What they say of themselves ----

# tells FILE TEXT..: iinfo -v prints every one of these.
tells()
{
    local file=$1 text
    shift
    iinfo -v "$file" >said 2>&1 || { cat said; return 1; }
    for text; do grep -qF -- "$text" said || { echo "no '$text' of $file"; cat said; return 1; }; done
}

for kind in dpx exr; do
    check "$kind of 525i" convert --timecode "01:00:00;02" -o "525.####.$kind"
    check "$kind of 625i" convert --raster 625i --subframe-rate 400 --timecode 10:00:00:24 -o "625.####.$kind"
done
check "DPX of 1080p" convert --raster 1080p25 --subframe-rate 400 -o p.0.####.dpx
if has iinfo; then
    check "525i DPX" tells 525.0000.dpx "dpx:Interlace: 1" "dpx:FieldNumber: 2" \
        "dpx:FrameRate: 29.97" "dpx:TemporalFrameRate: 29.97" 'dpx:TimeCode: "01:00:00;02"' \
        "oiio:BitsPerSample: 10" 'dpx:Transfer: "ITU-R 601-5 system M"' "PixelAspectRatio: 0.9090"
    check "625i DPX" tells 625.0000.dpx "dpx:Interlace: 1" "dpx:FieldNumber: 1" \
        "dpx:FrameRate: 25" "10:00:00:24" 'dpx:Transfer: "ITU-R 601-5 system B or G"'
    check "1080p DPX" tells p.0.0000.dpx "dpx:Interlace: 0" 'dpx:Transfer: "ITU-R 709-4"'
    check "525i EXR" tells 525.0000.exr "framesPerSecond: 30000/1001" 'weft:raster: "525i"' \
        "PixelAspectRatio: 0.909091" "smpte:TimeCode: 01:00:00" "float openexr"
fi
if has mediainfo; then
    check "MediaInfo reads DPX" grep -q "^720 486 10 29.970" \
        <(mediainfo --Inform="Image;%Width% %Height% %BitDepth% %FrameRate%" 525.0000.dpx)
fi

finish
