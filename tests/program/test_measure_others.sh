#!/bin/bash
# 'weft measure' on video of other programs, and differences beside ffmpeg's.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "test_jobs.sh measures a container"
needs ffmpeg
needs_libav

subframes in 96
clip tff.y4m 400 360x288@25i,tff

# ---- Other programs' video ----

exits 0 weft measure tff.y4m --json && cp out y4m.json
for way in mov:v210 mkv:ffv1 mov:prores_ks avi:ffvhuff; do
    file=copy.${way%:*}
    quiet_ffmpeg -i tff.y4m -c:v "${way#*:}" -flags +ildct -field_order tt "$file"
    check "$way is measured" exits 0 weft measure "$file" --json
    check "$way is as the Y4M" value "d['order']['verdict'] == 'tff' and d['frames'] == 6 and
        abs(d['flicker']['rms'] / json.load(open('y4m.json'))['flicker']['rms'] - 1) < 0.1"
done
check "v210 in MOV is the Y4M bit for bit" exits 0 weft measure copy.avi --against tff.y4m --json
check "no difference" value "d['difference']['rmse'] == 0"
quiet_ffmpeg -i tff.y4m -pix_fmt yuv420p -c:v mpeg2video -flags +ildct+ilme -qscale 3 x.mpg
check "MPEG-2 is measured" verdict x.mpg tff
head -c 200000 copy.mov >cut.mov
check "a cut MOV is refused" exits 1 weft measure cut.mov
check "and named" says cut.mov
size=$(stat -c %s copy.mkv)
head -c $((size * 7 / 10)) copy.mkv >cut.mkv
check "a cut Matroska is refused" exits 1 weft measure cut.mkv
check "and its end is told" says "ends after"
quiet_ffmpeg -f lavfi -i testsrc=s=320x240:r=25:d=2 -pix_fmt yuv420p -c:v mpeg4 -g 12 long.mp4
quiet_ffmpeg -ss 0.5 -i long.mp4 -c copy trimmed.mp4
check "an edit list is not" exits 0 weft measure trimmed.mp4
cp copy.mkv take:1.mkv
check "a colon in a name" exits 0 weft measure take:1.mkv
for tag in bt709 smpte170m; do
    quiet_ffmpeg -f lavfi -i smptebars=s=720x576:r=25:d=0.2 -pix_fmt yuv422p -c:v ffv1 \
        -colorspace $tag tag-$tag.mkv
    check "$tag" exits 0 weft measure tag-$tag.mkv --json
    cp out $tag.json
done
check "the matrix that is tagged is taken" value "d['flicker'] != json.load(open('bt709.json'))['flicker']"
for tag in smpte2084 arib-std-b67; do
    quiet_ffmpeg -f lavfi -i smptebars=s=720x576:r=25:d=0.2 -pix_fmt yuv422p10le -c:v ffv1 \
        -color_trc $tag pq.mkv
    check "$tag" exits 0 weft measure pq.mkv --json
    check "$tag is another display" value "d['flicker'] != json.load(open('smpte170m.json'))['flicker']"
done
quiet_ffmpeg -f lavfi -i sine=d=0.1 sound.wav
check "a sound file is refused" exits 1 weft measure sound.wav

# ---- Differences beside ffmpeg's ----

"$WEFT" convert in --subframe-rate 400 --raster 360x288@25i,tff --aperture notch -q -o other.y4m
check "difference" exits 0 weft measure other.y4m --against tff.y4m --json
ffmpeg -nostdin -hide_banner -i other.y4m -i tff.y4m -lavfi '[0]split[a][b];[1]split[c][d];[a][c]psnr;[b][d]ssim' \
    -f null - >ffmpeg.log 2>&1
theirs() { sed -n "s/.*$1.* $2:\([0-9.]*\).*/\1/p" ffmpeg.log; }
check "PSNR is ffmpeg's" value "abs(d['difference']['psnr'] - $(theirs PSNR average)) < 2e-3"
check "PSNR of luma is ffmpeg's" value "abs(d['planes']['y']['frame']['psnr'] - $(theirs PSNR y)) < 2e-3"
check "SSIM of luma is ffmpeg's" value "abs(d['planes']['y']['frame']['ssim'] - $(theirs SSIM Y)) < 2e-5"
quiet_ffmpeg -i other.y4m -pix_fmt gray10le -strict -1 gray1.y4m
quiet_ffmpeg -i tff.y4m -pix_fmt gray10le -strict -1 gray2.y4m
check "lone luma" exits 0 weft measure gray1.y4m --against gray2.y4m --json
check "is not thinned by empty chroma" value "d['difference']['psnr'] == d['planes']['y']['frame']['psnr'] and
    list(d['planes']) == ['y']"

finish
