#!/bin/bash
# Which material a file says it is: the same job makes the same bytes, two shots never have the same numbers, and
# verify tells of zero and of shared ones. And that all tracks of sound are heard.
. "$WEFT_SOURCE/tests/program/script.sh"
. "$WEFT_SOURCE/tests/verify/foreign.sh"

not_sanitized "test_jobs.sh verifies"
needs_libav
needs ffmpeg
subframes in 96
# Another shot, of which all but the last frame are the same.
cp -d -r in other && for k in 8{0,1,2,3,4,5,6,7,8,9} 9{0,1,2,3,4,5}; do ln -sf "$(readlink in/subframe.0000.exr)" other/subframe.00$k.exr; done

# shot FOLDER OUTPUT OPTION..
shot()
{
    local folder=$1 output=$2
    shift 2
    exits 0 weft convert "$folder" --subframe-rate 400 --aperture box --temporal-width 0 -q --overwrite -o "$output" "$@"
}
# id FILE: what verify says of its identity.
id() { weft verify --json "$1" 2>said | python3 -c 'import json, sys
print([c["is"] for c in json.load(sys.stdin)[0]["checks"] if c["check"] == "identity"][0])'; }

small=(--raster 180x122@25i,tff --audio silent:2)
while read -r name options; do
    # shellcheck disable=SC2086
    check "$name" shot in "$name" $options "${small[@]}"
    # shellcheck disable=SC2086
    check "$name again" shot in "again.$name" $options "${small[@]}" --threads 2
    check "has the same bytes" cmp "$name" "again.$name"
    # shellcheck disable=SC2086
    check "$name of another shot" shot other "other.$name" $options "${small[@]}"
    [ "${name##*.}" = mov ] && continue
    check "has another number" bash -c "[ '$(id "$name")' != '$(id "other.$name")' ]"
    check "all three are right together" right "$name" "again.$name" "other.$name"
done <<'END_OF_TABLE'
own.mxf --codec v210
ffv1.mkv --codec ffv1
v210.mov --codec v210
END_OF_TABLE
small=(--raster 625i --audio silent:4)
check "D-10" shot in d10.mxf --codec imx50 "${small[@]}"
check "again" shot in again.mxf --codec imx50 "${small[@]}" --threads 2
check "has the same bytes" cmp d10.mxf again.mxf
check "D-10 of another shot" shot other other.mxf --codec imx50 "${small[@]}"
check "has another number" bash -c "[ '$(id d10.mxf)' != '$(id other.mxf)' ]"
check "every system item has it" bash -c "grep -c -a -o -P '\x06\x0a\x2b\x34\x01\x01\x01\x05\x01\x01\x0d\x00\x13\x00\x00\x00\x00{15}' d10.mxf | grep -q '^0$'"
check "the packages are named by their numbers" bash -c "ffprobe -v error -show_entries format_tags=material_package_name,material_package_umid -of csv=p=0 own.mxf |
    tr A-F a-f | grep -Eq '([0-9a-f]{32}),weft \1$|weft ([0-9a-f]{32}),0x[0-9a-f]{32}\2$'"

# ---- Dates are the job's ----

dated() { ffprobe -v error -show_entries format_tags=creation_time,modification_date -of default=nw=1:nk=1 "$1"; }
while read -r name codec raster; do
    check "$name" shot in "date_$name" --codec "$codec" --raster "$raster" --date 2026-11-30T10:20:30Z
    check "$name again" shot in "again_$name" --codec "$codec" --raster "$raster" --date 2026-11-30T10:20:30Z
    check "$name has the same bytes" cmp "date_$name" "again_$name"
    check "$name says its date" same "$(dated "date_$name")" 2026-11-30T10:20:30.000000Z
    check "$name is right" right "date_$name"
    check "$name without" shot in "un_$name" --codec "$codec" --raster "$raster"
    check "$name says none" same "$(dated "un_$name" | sed '/^0000-00-00\|^-0001/d')" ""
    check "$name is right without" right "un_$name"
done <<'END_OF_TABLE'
own.mxf v210 625i
d10.mxf imx50 625i
m.mov v210 525i
f.mkv ffv1 625i
END_OF_TABLE

# ---- What verify tells ----

ff -i d10.mxf -map 0 -c copy -fflags +bitexact -timecode 10:00:00:00 -f mxf_d10 zero.mxf
check "zeros are no number" found zero.mxf "identity" ""
patched own.mxf spoiled.mxf end - -20000 00
check "alone it is right" right spoiled.mxf
check "two shots with one number are not" exits 1 weft verify own.mxf spoiled.mxf
check "which is told of both" test "$(grep -c 'WRONG  identity' out)" = 2
check "and of nothing else" test "$(grep -c WRONG out)" = 2
cp own.mxf copy.mxf
check "a copy is the same shot" right own.mxf copy.mxf
cp ffv1.mkv zero.mkv
python3 - <<'PY'
data = open("zero.mkv", "rb").read()
at = data.index(b"\x73\xa4\x90")
import zlib
info = data.rindex(b"\x15\x49\xa9\x66", 0, at)
size = data[info + 4] & 0x7F if data[info + 4] & 0x80 else int.from_bytes(data[info + 4 : info + 6], "big") & 0x3FFF
begin = info + (5 if data[info + 4] & 0x80 else 6)
body = bytearray(data[begin : begin + size])
place = at - begin
body[place + 3 : place + 19] = bytes(16)
assert zlib.crc32(data[begin + 6 : begin + size]) == int.from_bytes(data[begin + 2 : begin + 6], "little")
body[2:6] = zlib.crc32(bytes(body[6:])).to_bytes(4, "little")
open("zero.mkv", "wb").write(data[:begin] + bytes(body) + data[begin + size :])
PY
check "nor are they in Matroska, whose checksum holds" found zero.mkv "identity" ""

# ---- Tracks that are heard ----

check "eight tracks" shot in s.mov --codec v210 --raster 625i --audio silent:8
check "are heard" right s.mov --profile v210-625
patched s.mov mute.mov sound tkhd 3 06
check "or not" found mute.mov "heard" "" --profile v210-625
check "which only a profile minds" found mute.mov "" "heard"
patched s.mov grouped.mov sound tkhd 34 0001
check "of a group one is played" found grouped.mov "heard" "" --profile v210-625
check "they say their channels" bash -c "[ \$(ffprobe -v error -select_streams a -show_entries stream=channel_layout -of csv=p=0 s.mov | grep -c mono) = 8 ] && [ \$(grep -a -o chan s.mov | wc -l) = 8 ]"
finish
