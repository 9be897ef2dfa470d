#!/bin/bash
# Every line of the guides that pipes Y4M into ffmpeg is run with the rasters that the comment above it names: what comes
# of it says the order of its fields, to weft and to ffprobe, and shows it, to weft and to idet.
. "$WEFT_SOURCE/tests/program/script.sh"
not_sanitized "test_jobs.sh converts"
needs_libav
needs ffmpeg ffprobe
subframes in 40

# lines: the rasters, and the line, of each.
lines()
{
    awk '/^    # / {rasters = $0; sub(/.*: /, "", rasters)} /^    weft .*\| ffmpeg -i - / {print rasters "\t" $0}' \
        "$WEFT_SOURCE"/README.md "$WEFT_SOURCE"/examples/guides/*.md
}

# run LINE RASTER: the line on the subframes of the test; its file becomes out.ENDING.
run()
{
    local line
    line=$(sed -E "s#convert shot --subframe-rate [0-9/]+ --raster [^ ]+#convert in --subframe-rate 400 --aperture box \
--temporal-width 0 -q --raster $2#; s#ffmpeg -i - #ffmpeg -v error -y -i - #; s# shot\.# out.#" <<<"$1")
    bash -o pipefail -c "weft() { '$WEFT' \"\$@\"; }; $line" 2>said || { cat said; return 1; }
}

# order FILE RASTER
order()
{
    local first=bottom letters=bff said
    [ "$(stat -c %s "$1")" -gt 0 ] || return 1
    case $2 in 525i-imx | 525i-rp202 | 625i | 1080i*) first=top letters=tff ;; esac
    weft verify --json "$1" >out 2>/dev/null
    value "{c['check']: (c['verdict'], c['is']) for c in d[0]['checks']}['flags'][1] == '$first first'" || return 1
    value "{c['check']: c['is'] for c in d[0]['checks']}['order'] == '$letters'" || return 1
    said=$(stream "$1" stream=field_order)
    case $first:${said%%,*} in
    top:tt* | top:tb* | bottom:bb* | bottom:bt*) ;;
    *) echo "ffprobe: $said, not $first"; return 1 ;;
    esac
    ffmpeg -nostdin -hide_banner -i "$1" -vf idet -f null - 2>&1 |
        grep -Eq "Multi frame detection:.*${letters^^}: *[1-9]" || { echo "idet sees another order"; return 1; }
}

count=0
while IFS=$'\t' read -r rasters line; do
    case $line in *libx264*) ffmpeg -hide_banner -encoders 2>/dev/null | grep -q libx264 || { skip_part "no libx264"; continue; } ;; esac
    is_long || rasters=${rasters/ 1080i59.94 1080i60/}
    for raster in $rasters; do
        check "$raster: $line" run "$line" "$raster"
        check "$raster has its order: $line" order "out.${line##*.}" "$raster"
        count=$((count + 1))
    done
done < <(lines)
check "there are lines" test $count -ge 14
check "libx264 alone calls all top first" run "weft convert shot --subframe-rate 480 --raster 525i -o - | ffmpeg -i - -c:v libx264 -flags +ildct+ilme shot.mp4" 525i
check "which is seen" eval '! order out.mp4 525i >/dev/null'
finish
