#!/bin/bash
# From a fresh Debian 12 to interlaced video: installs what is missing, builds weft (all of it, so that
# `cmake --install build` works next), renders a little of the carousel, and converts a short sequence
# of high-rate subframes.

set -eu
source_dir=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$source_dir"
. tests/packages.sh

echo "1/4 Packages"
install_packages "${build_packages[@]}"

echo "2/4 Build (Release, in build/)"
mkdir -p out
new=(-G Ninja -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=OFF)
[ ! -f build/CMakeCache.txt ] || new=()
{ cmake -S . -B build "${new[@]}" &&
    cmake --build build --parallel "$(nproc)"; } >out/build.log 2>&1 ||
    { cat out/build.log; exit 1; }

echo "3/4 The carousel: half a second of 525-line interlaced video, and a still"
build/weft render examples/scenes/carousel.lua --frames 0-14 --samples 16 \
    -o out/carousel.y4m --overwrite
build/weft render examples/scenes/carousel.lua --raster 1280x720@30p --frames 0 --samples 32 \
    --bits 8 -o out/carousel.png --overwrite

echo "4/4 A sequence of 128 subframes, 480 a second, in out/subframes/, converted"
build/make_subframes out/subframes
build/weft convert out/subframes -o out/quickstart.y4m --overwrite
build/weft convert out/subframes -o out/quickstart.####.png --overwrite

cat <<END

Done. In $source_dir/out:
  carousel.png          one instant of a scene that comes along, progressive
  carousel.y4m          15 frames (30 fields) of it, 720x486 at 29.97, bottom field first
  quickstart.y4m        8 frames from 128 subframes, as any renderer can make them
  quickstart.0000.png   the same frames as pictures, both fields woven

Look at the PNGs first: in quickstart.0000.png moving edges show the comb of two fields a 1/60
second apart; still patches and level lines do not flicker between fields. Play the video with a
deinterlacer that shows every field:
  ffplay -loop 0 -vf bwdif out/carousel.y4m
  mpv --loop --deinterlace=yes out/carousel.y4m

Then try
  build/weft render examples/scenes/panorama.lua -o out/panorama.y4m  what else scenes can do
  build/weft convert out/subframes --aperture line -o out/line.y4m    what flickers without a filter
  build/weft filters                                                  the apertures there are
  build/weft convert YOUR.####.exr --subframe-rate 240 -o yours.y4m   your own render
END
