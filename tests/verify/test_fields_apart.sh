#!/bin/bash
# Fields that are files of their own are read back: measured, they are the frames that they came from, figure by figure,
# and verify puts them to the same checks.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "test_jobs.sh measures"
subframes in 64

# apart RASTER ENDING
apart()
{
    rm -f ./*."$2"
    check "$1 as $2" made "w.####.$2" --raster "$1"
    check "fields apart" made "f.####.$2" --raster "$1" --fields separate
    for kind in w f; do
        check "measured" exits 0 weft measure --json "$kind.####.$2"
        grep -v '"path"' out >$kind.json
    done
    check "as the frames are" cmp w.json f.json
    check "and right" exits 0 weft verify "f.####.$2"
}
for ending in exr dpx png tif; do apart 180x122@25i,bff $ending; done
apart 180x122@25i,tff png
apart 525i dpx
check "a field that is missing at the end" rm "$(ls f.*.png | tail -n 1)"
check "is told" only reading "f.####.png"
check "in a word" grep -q "do not make whole frames" out
# The order is what the files' raster says; the same files called the other way are wrong in it.
check "fields of 625 lines" made g.####.dpx --raster 625i --fields separate
check "are not bottom first" exits 1 weft verify g.####.dpx --raster 720x576@25i,bff,par=12:11,601-625
check "which their pixels tell" prints "WRONG  order"
finish
