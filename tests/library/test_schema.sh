#!/bin/bash
# The published schemas hold of the reports that commands write: of every kind, also of what failed.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "the tests of the commands"
schema=$WEFT_SOURCE/convert/schema
scenes=$WEFT_SOURCE/examples/scenes
small='--raster 36x24@30i,tff -q'

# holds NAME FILE..: the files are as the schema of that name has it.
holds() { python3 "$WEFT_SOURCE/tests/library/schema_check.py" "$schema/$1.json" "${@:2}"; }

# shellcheck disable=SC2086
{
    weft render "$scenes/carousel.lua" $small --frames 0-1 --samples 4 -o a.y4m --report report1.json
    weft render "$scenes/carousel.lua" $small --frames 0 --samples 4 -o b.#.exr --report report2.json
    weft trace "$scenes/carousel.lua" $small --frames 0-1 --oversample 1x1x4 -o t.####.exr --report report3.json
    weft trace "$scenes/carousel.lua" $small --frames 0 --samples 2 -o d.####.exr --report report4.json
    weft convert t.####.exr --subframe-rate 240 $small -o c.y4m --legalize r103 --report report5.json
    weft convert t.####.exr --subframe-rate 240 $small -o e.y4m --dry-run --report report6.json
    weft convert t.####.exr --subframe-rate 240 $small -o f.y4m --flicker-limit 0.05 --report report7.json
    weft convert none.####.exr --subframe-rate 240 $small -o g.y4m --report report8.json
    weft convert t.####.exr --subframe-rate 240 $small -o h.####.png --key k.####.png --report report9.json
    weft render "$scenes/carousel.lua" $small --dry-run --frames 0 -o i.y4m --report report10.json
    weft measure a.y4m --json >measure1.json
    weft measure a.y4m none.y4m b.0.exr --against a.y4m --json >measure2.json
    weft measure b.0.exr --chart zoneplate --json >measure3.json
    weft verify a.y4m none.mov c.y4m --json >verify1.json
    weft verify a.y4m --profile xdcamhd422-1080i50 --json >verify2.json
    weft info a.y4m none.mov t.####.exr b.0.exr h.0000.png --json >info1.json
    weft filters --json >filters1.json
    weft filters box --input-lines 48 --raster 36x24@30i --json >filters2.json
    weft filters design sharp=0.7 --json >filters3.json
    weft rasters --json >rasters1.json
    weft rasters 10x10@24p --json >rasters2.json
    weft verify --profiles --json >profiles1.json
    weft plan --raster 1080i50 --frames 0-1 --subframe-rate 400 --format json >plan1.json
    weft plan --raster 36x24@30i --frames 0-1 --subframe-rate 240 --samples-a-pixel 9 --format json >plan2.json
} >/dev/null 2>&1

for name in report measure verify info filters rasters profiles plan; do
    check "reports of $name" holds $name "$name"[0-9]*.json
    check "every report of $name was written" test "$(find . -name "$name[0-9]*.json" -size 0 | wc -l)" = 0
    check "changes to one of $name are found" \
        python3 "$WEFT_SOURCE/tests/library/schema_check.py" "$schema/$name.json" --sins "${name}1.json"
done
# Lists of jobs are in jobs/test_joblist.sh.
check "each schema is of a report" test "$(ls "$schema" | grep -v '^jobs'  | sed 's/\.json//' | sort | tr '\n' ' ')" = \
    "$(ls -- *1.json | sed -n 's/^\([a-z]*\)1\.json/\1/p' | sort -u | tr '\n' ' ')"
finish
