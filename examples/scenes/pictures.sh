#!/bin/bash
# Makes the pictures of README.md: pictures.sh [WEFT]. WEFT is the program; default: weft.
set -eu
cd "$(dirname "$0")"
weft=${1:-weft}
mkdir -p pictures/scenes

for scene in carousel wheel slow_edges csg_grid still one_mover zoneplate panorama; do
    set -- "$scene.lua" --raster 320x240@30p,par=1:1 --frames 10 --bits 8 --samples 64 --overwrite
    [ "$scene" = panorama ] && set -- "$@" --frames 40
    [ "$scene" = csg_grid ] && set -- "$@" --set n=400
    "$weft" render "$@" -o "pictures/scenes/$scene.png"
done

for feature in $(grep -o '^    [a-z_]* = function' gallery.lua | awk '{print $1}'); do
    "$weft" render gallery.lua --set show="$feature" --raster 160x120@30p,par=1:1 --frames 0 \
        --bits 8 --temporal-width 1 --samples 256 --overwrite -o "pictures/$feature.png"
done
