#!/bin/bash
# 'weft measure --display' with FFmpeg's deinterlacers, beside ffmpeg itself, and what is seen of flicker.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "test_jobs.sh measures"

has_deinterlacers() { [ -n "$(find "$WEFT_BUILD" -maxdepth 4 -name weft-deinterlace.so -print -quit)" ]; }

# ---- What is seen ----

render() { "$WEFT" render "$WEFT_SOURCE/examples/scenes/$1.lua" -q --samples 4 "${@:2}"; }
render still --raster 240x160@30i,tff --frames 0-1 --aperture line -o still.y4m
check "what is seen" exits 0 weft measure still.y4m --json
check "is more than nothing, and less from afar" value "d['flicker']['visible']['jnd_p999'] > 1" &&
    cp out near.json
check "from afar" exits 0 weft measure still.y4m --json --view-distance 30
check "what flickers blends with what does not" value \
    "d['flicker']['visible']['jnd_p999'] < json.load(open('near.json'))['flicker']['visible']['jnd_p999']"
check "in the dark" exits 0 weft measure still.y4m --json --peak 1
check "less is seen" value \
    "d['flicker']['visible']['jnd_p999'] < .2 * json.load(open('near.json'))['flicker']['visible']['jnd_p999']"
check "the light is the same" value "d['flicker']['rms'] == json.load(open('near.json'))['flicker']['rms']"
check "for people" exits 0 weft measure still.y4m
check "it is told" prints " JND"
check "a limit" exits 1 weft measure still.y4m --limit flicker.visible.jnd_p999=0.5
check "which is said" says "flicker.visible.jnd_p999 is"

# Any number of threads gives the same figures and the same heat, of what flickers and of what crawls.
render slow_edges --raster 240x160@30i,tff --frames 0-4 -o slow.y4m
for video in still slow; do
    for threads in 1 2 5; do
        check "$video with $threads threads" exits 0 \
            weft measure $video.y4m --json --threads $threads --heatmap heat$threads.png --heat crawl
        cp out threads$threads.json
        check "the same figures" cmp threads$threads.json threads1.json
        check "the same heat" cmp heat$threads.png heat1.png
    done
done
check "no thread" refuses "--threads" measure still.y4m --threads 0

check "no distance" refuses "--view-distance" measure still.y4m --view-distance 0
check "no number" refuses "--view-distance" measure still.y4m --view-distance far
check "too dark" refuses "--peak" measure still.y4m --peak 0.1
check "no such heat" refuses "--heat" measure still.y4m --heatmap h.png --heat warm
for heat in visible crawl; do
    check "a map of $heat" exits 0 weft measure still.y4m --heatmap $heat.png --heat $heat
    check "is a picture" png $heat.png
done
"$WEFT" render "$WEFT_SOURCE/examples/scenes/still.lua" -q --samples 1 --raster 240x160@30p --frames 0-0 -o still.dpx
check "no crawl where no field is first" refuses "no crawl" measure still.dpx --heatmap h.png --heat crawl

# ---- Deinterlacers ----

if ! has_deinterlacers; then
    check "a display that is not built in" fails "libavfilter" weft measure still.y4m --display bwdif
    finish
fi
needs ffmpeg

theirs() { sed -n "s/.*$1.* $2:\([0-9.]*\).*/\1/p" ffmpeg.log; }

# beside NAME FILTER VIDEO REFERENCE: PSNR and SSIM of the deinterlaced video are ffmpeg's.
beside()
{
    ffmpeg -nostdin -hide_banner -i "$3" -i "$4" -lavfi "[0]$2,split[a][b];[1]split[c][d];[a][c]psnr;[b][d]ssim" \
        -f null - >ffmpeg.log 2>&1
    check "$1 of $3" exits 0 weft measure "$3" --display "$1" --against "$4" --json
    check "PSNR is ffmpeg's $(theirs PSNR average)" value \
        "abs(d['difference']['psnr'] - $(theirs PSNR average)) < .005 and d['difference']['psnr'] < 60"
    check "PSNR of luma is" value "abs(d['planes']['y']['frame']['psnr'] - $(theirs PSNR y)) < .005"
    check "SSIM of luma is" value "abs(d['planes']['y']['frame']['ssim'] - $(theirs SSIM Y)) < 1e-4"
}

for order in tff bff; do
    render slow_edges --raster 240x160@30i,$order --frames 0-5 --aperture box -o $order.y4m
done
render slow_edges --raster 240x160@60p --frames 0-11 --aperture line -o reference.y4m
for order in tff bff; do
    beside bwdif bwdif $order.y4m reference.y4m
    cp out $order.json
done
beside yadif yadif=mode=send_field tff.y4m reference.y4m
beside w3fdif w3fdif tff.y4m reference.y4m
check "both orders are deinterlaced alike" value \
    "abs(json.load(open('tff.json'))['difference']['psnr'] - json.load(open('bff.json'))['difference']['psnr']) < 1"
check "the other order" exits 0 weft measure tff.y4m --raster 240x160@30i,bff --display bwdif --against reference.y4m --json
check "is worse" value "d['difference']['psnr'] < json.load(open('tff.json'))['difference']['psnr'] - 1"

for bits in yuv420p:8 yuv444p12le:12; do
    quiet_ffmpeg -i tff.y4m -pix_fmt ${bits%:*} -flags +ildct -top 1 -c:v ffv1 -field_order tt woven.avi
    quiet_ffmpeg -i reference.y4m -pix_fmt ${bits%:*} -c:v ffv1 whole.avi
    has_libav && beside bwdif bwdif woven.avi whole.avi
done

check "pictures of light" render slow_edges --raster 240x160@30i,tff --frames 0-3 -o 'light.####.exr'
check "and a reference" render slow_edges --raster 240x160@60p --frames 0-7 --aperture line -o 'whole.####.exr'
check "are deinterlaced too" exits 0 weft measure 'light.####.exr' --raster 240x160@30i,tff --display bwdif --json \
    --against 'whole.####.exr'
check "and compared" value "20 < d['difference']['psnr'] < 50"

check "flicker of a still" exits 0 weft measure still.y4m --display bwdif --json
check "a deinterlacer takes most of it" value "0 <= d['flicker']['rms'] and
    d['flicker']['rms'] < json.load(open('near.json'))['flicker']['rms'] and d['crawl']['rms'] is None"
check "without a reference there is no difference" value "d['difference']['psnr'] is None"
check "for people" exits 0 weft measure still.y4m --display yadif
check "the display is named" prints "interline flicker, yadif"

check "a reference of the wrong rate" refuses "60 frames a second" measure tff.y4m --display bwdif --against bff.y4m
render slow_edges --raster 240x160@60p --frames 0-9 --aperture line -o short.y4m
check "a short one" fails "more fields" weft measure tff.y4m --display bwdif --against short.y4m
render slow_edges --raster 240x160@60p --frames 0-13 --aperture line -o long.y4m
check "a long one" fails "fewer fields" weft measure tff.y4m --display bwdif --against long.y4m
quiet_ffmpeg -f lavfi -i testsrc=s=16x2:r=25:d=0.2 -pix_fmt yuv444p -strict -1 low.y4m
check "two lines" fails "16x2 as yuv444p" weft measure low.y4m --raster 16x2@25i --display bwdif
check "one frame" exits 0 weft measure light.0000.exr --raster 240x160@30i,tff --display bwdif --json
check "is shown by itself" value "d['frames'] == 1 and d['flicker']['rms'] is not None"

finish
