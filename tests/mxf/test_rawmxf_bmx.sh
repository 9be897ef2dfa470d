#!/bin/bash
# Uncompressed MXF is laid out as bmx asks for, item by item; that form, and the one that ffmpeg writes for woven fields,
# are read alike. bmx itself is not run.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "test_mxf.c and test_jobs.sh write them"
needs python3
. "$WEFT_SOURCE/tests/mxf/rawmxf.sh"

asked() { "$python3" "$WEFT_SOURCE/tests/mxf/bmx_layout.py" "$@" || { echo "of $*"; return 1; }; }

while read -r raster codec bits; do
    check "$raster, $codec" write out.mxf "$raster" --codec "$codec"
    check "$raster, $codec: as bmx asks" asked out.mxf "$raster" "$bits"
done <<<'525i v210 10
525i uyvy 8
525i-imx v210 10
625i uyvy 8
1080i50 v210 10
1080i59.94 uyvy 8
1080i60 v210 10
1080p25 v210 10
720p50 uyvy 8'

# ---- Both forms are read ----

# alike RASTER ORDER: the same frames called separate fields are measured and converted as the mixed ones are.
alike()
{
    local lines
    check "$1" write mixed.mxf "$1" --codec v210
    lines=$(weft info --json mixed.mxf | "$python3" -c 'import json, sys; print(json.load(sys.stdin)["files"][0]["height"] // 2)')
    printf -v lines '%08x' "$lines"
    cp mixed.mxf apart.mxf
    for item in 320c:01 3202:"$lines" 3204:"$lines" 3208:"$lines"; do
        check "called separate" patched apart.mxf next.mxf item "${item%:*}" 0 "${item#*:}"
        mv next.mxf apart.mxf
    done
    check "not as bmx asks" asked apart.mxf "$1" 10 broken
    for kind in mixed apart; do
        check "$kind is right" right $kind.mxf --raster "$1"
        check "$kind: its order is said" exits 0 weft info $kind.mxf
        check "$kind: $2" prints "$2"
        check "$kind is measured" exits 0 weft measure --json $kind.mxf
        grep -v '"path"' out >$kind.json
        check "$kind is converted" exits 0 weft convert $kind.mxf --input-scan progressive --raster 1080p25 --overwrite -q -o $kind.y4m
    done
    check "measured alike" cmp mixed.json apart.json
    check "converted alike" cmp mixed.y4m apart.y4m
}
if has_libav; then
    alike 625i "top first"
    alike 525i "bottom first"
    check "another field first" patched mixed.mxf second.mxf item 3212 0 02
    check "is another order" exits 0 weft info second.mxf
    check "which is said" prints "top first"
else
    skip_part "what is read, as weft was built without libav"
fi

finish
