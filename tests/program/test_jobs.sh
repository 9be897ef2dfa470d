#!/bin/bash
# One small job of every kind, from end to end: what the sanitizers see of the whole program where the
# longer scripts take them too long.
. "$WEFT_SOURCE/tests/program/script.sh"
scene=$WEFT_SOURCE/examples/scenes/carousel.lua
raster=48x36@30i,tff
small=(--raster $raster -q)

# ---- Scenes ----

check "render" exits 0 weft render "$scene" "${small[@]}" --samples 4 --frames 0-1 -o r.y4m --report r.json
check "render to an error" exits 0 weft render "$scene" "${small[@]}" --error .05 --frames 0 --aperture line -o e.y4m
check "render without skipping" exits 0 weft render "$WEFT_SOURCE/examples/scenes/one_mover.lua" "${small[@]}" \
    --samples 2 --frames 0 --skip off -o m.y4m
check "render pulled down" exits 0 weft render "$scene" --raster 48x36@29.97i,bff -q --cadence 2:3 --samples 1 \
    --frames 0-4 -o film.y4m
check "trace subframes" exits 0 weft trace "$scene" "${small[@]}" --samples 1 --frames 0-3 --oversample 1x1x4 \
    -o in.####.exr
check "trace samples" exits 0 weft trace "$scene" "${small[@]}" --samples 2 --frames 0-1 -o deep.####.exr
check "convert samples" exits 0 weft convert deep.####.exr "${small[@]}" -o deep.y4m
check "convert them with alpha" exits 0 weft convert deep.####.exr "${small[@]}" --alpha-out --key deepkey.####.exr -o deep.####.png
echo 'background{alpha=0} camera{eye={0, 0, 9}, look_at={0, 0, 0}} add(sphere{}:material{refract=0.5}, box{min={-9, -1, 2}, max={0, 1, 3}}:material{holdout=true})' >open.lua
check "render alpha" exits 0 weft render open.lua "${small[@]}" --samples 2 --alpha-out --key key.y4m -o open.####.png
echo 'camera{eye={0, 0, 1}, look_at={0, 0, 0}} add(sphere{raduis=1})' >wrong.lua
check "a scene that is wrong" fails "radius" weft render wrong.lua "${small[@]}" -o no.y4m

# ---- Every form of output ----

convert=(weft convert in.####.exr --fit stretch -q)
for form in y4m v210 uyvy '####.dpx' '####.tif' '####.png' '####.exr'; do
    check "$form" exits 0 "${convert[@]}" --raster $raster -o "o.$form"
done
check "legal and adjusted" exits 0 "${convert[@]}" --raster $raster --legalize r103 --chroma luma-adjust \
    --dither tpdf --fix-nan box3 --aperture crisp -o legal.y4m --report legal.json
check "4:4:4 of 12 bits" exits 0 "${convert[@]}" --raster $raster --chroma 444 --bits 12 --range full -o 444.y4m
check "fields apart" exits 0 "${convert[@]}" --raster $raster --fields separate -o f.####.dpx
check "alpha" exits 0 "${convert[@]}" --raster $raster --alpha-out --key-law encoded --fill straight --key key.####.png -o alpha.####.tif
check "another space" exits 0 "${convert[@]}" --raster $raster --from ACEScg --to rec2020 -o space.y4m
check "a chunk" exits 0 "${convert[@]}" --raster $raster --chunk 2/2 --threads 3 -o chunk.y4m
check "the rest" exits 0 "${convert[@]}" --raster $raster --resume -o "o.####.dpx"
check "a dry run" exits 0 "${convert[@]}" --raster $raster --dry-run --report plan.json -o dry.y4m
check "uncompressed MXF" exits 0 "${convert[@]}" --raster $raster --codec uyvy --audio silent:2 --timecode 01:00:00:00 \
    -o o.mxf
rm in.0005.exr
check "a hole" exits 3 "${convert[@]}" --raster $raster --on-missing hold -o hole.y4m
check "a hole is an error" fails "missing" "${convert[@]}" --raster $raster -o no.y4m

# ---- Standard definition: containers, composite, what is measured and verified ----

check "a picture" exits 0 weft render "$WEFT_SOURCE/examples/scenes/still.lua" --raster 525i --samples 1 --frames 0 -q \
    -o sd.y4m
check "as pictures" exits 0 weft render "$WEFT_SOURCE/examples/scenes/still.lua" --raster 525i --samples 1 --frames 0 -q \
    -o sd.####.exr
for n in 1 2 3; do cp sd.0000.exr sd.000$n.exr; done
if has_libav; then
    while read -r file codec; do
        check "$codec" exits 0 weft convert sd.####.exr --subframe-rate 60000/1001 --raster 525i \
            --temporal-width 0 -q --codec "$codec" --audio silent:2 --timecode "01:00:00;00" -o "$file"
        check "$codec is verified" exits 0 weft verify "$file" --raster 525i
        check "$codec is measured" exits 0 weft measure "$file" --json
    done <<<'v210.mov v210
prores.mov prores
ffv1.mkv ffv1'
    for row in "a.mov prores-4444" "a.mkv ffv1"; do
        read -r file codec <<<"$row"
        check "alpha in $codec" exits 3 "${convert[@]}" --raster $raster --on-missing hold --alpha-out --codec "$codec" -o "$file"
    done
    python3 "$WEFT_SOURCE/tests/input/sound.py" wav noise.wav 44100 16 3 4000
    check "sound of a file" exits 0 weft render "$WEFT_SOURCE/examples/scenes/still.lua" --raster 64x48@25p --samples 1 \
        --frames 0-2 -q --audio noise.wav:0.01 --audio-tracks 4 -o sound.mov
    check "sound of a video" exits 0 weft convert sound.mov --raster 64x48@29.97p -q --audio copy --audio-bits 16 -o sound.mkv
    check "a tone" exits 0 weft convert sound.mov --raster 64x48@25p --codec uyvy -q --audio tone:3 --audio-bits 16 -o sound.mxf
fi
check "composite" exits 0 weft composite sd.y4m -o seen.y4m --encoder filtered --decoder comb3
check "difference" exits 0 weft measure seen.y4m --against sd.y4m --heatmap heat.png
check "what is seen" exits 0 weft measure sd.0000.exr --raster 525i --view-distance 4 --peak 80 --heatmap heat.png --heat visible
if [ -n "$(find "$WEFT_BUILD" -maxdepth 4 -name weft-deinterlace.so -print -quit)" ]; then
    check "deinterlaced" exits 0 weft measure 'sd.####.exr' --raster 525i --display bwdif --json
fi
check "a limit of what is seen" exits 3 "${convert[@]}" --raster $raster --flicker-limit visible:1 --on-missing hold --overwrite -o o.y4m
check "a limit" fails "flicker.rms" weft measure sd.y4m --limit flicker.rms=0
check "verify" exits 0 weft verify sd.y4m --raster 525i
check "verify the other order" exits 1 weft verify sd.y4m --raster 525i-rp202
check "info" exits 0 weft info --json in.####.exr sd.y4m o.mxf

# ---- Apertures ----

check "plot" exits 0 weft filters shaped --input-lines 1080 --plot shaped.png
check "design" exits 0 weft filters design sharp=0.7,support=3 --json
check "rasters" exits 0 weft rasters --json
printf '{"inputs": "deep.####.exr", "output": "job.y4m", "raster": "%s"}' $raster >job.json
check "a job file" exits 0 weft convert --job job.json

finish
