# shellcheck shell=bash
# Sourced after script.sh: subframes with alpha in shot/, whose places laws.py knows.
# A block that hides all, one of alpha .5 and one of .1 without light, premultiplied; nothing elsewhere.
mkdir shot
for i in 0 1 2 3 4 5 6 7; do
    oiiotool --create 96x64 4 --fill:color=0.5,0.25,0.1,1:size=60x40+8+8 60x40+8+8 \
        --fill:color=0.25,0.125,0.05,0.5 16x30+76+20 --fill:color=0,0,0,0.1 16x10+76+4 -d float -o shot/s.000$i.exr
done
made_of()
{
    exits 0 weft convert shot --subframe-rate 192 --raster 96x64@24p --aperture line --temporal-width 0 -q --overwrite "$@"
}
