#!/bin/bash
# Makes the pictures of these pages: pictures.sh [WEFT]. It renders, with Blender and POV-Ray, and takes some minutes.
set -eu
cd "$(dirname "$0")"
export WEFT=${1:-${WEFT:-weft}}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p pictures

blender -b --factory-startup -P shot.py -- "$work/shot.blend"
blender -b "$work/shot.blend" -P ../blender/render.py -- --raster 640x360@25i --oversampling 1 --first 2 --last 2 \
    --only-render
"$WEFT" convert --job "$work/subframes/job.json" --bits 8 -o "$work/blender.####.png"
cp "$work"/blender.*2.png pictures/blender.png

export POVRAY_OPTIONS="+L../../tests/peers +WT2"
looks=(--raster 480x384@25i,par=16:15 --subframe-rate 400)
video=("${looks[@]}" --frames 0-47 --output-frames 2-2 --input-par 16:15 --bits 8)
../povray/render.py ../../tests/peers/wheel.pov "$work/wheel" "${looks[@]}" --frames 2-2
"$WEFT" convert "$work/wheel" "${video[@]}" -o "$work/povray.####.png"
"$WEFT" convert "$work/wheel" "${video[@]}" --aperture line --temporal-width 0 -o "$work/camera.####.png"
cp "$work"/povray.*2.png pictures/povray.png
cp "$work"/camera.*2.png pictures/povray_unfiltered.png
