#!/bin/bash
# How fast subframes become fields, beside what else could be done with the same files: a floor that
# only inflates them, and ffmpeg's way (scale in gamma-less RGB, mix eight, interlace). Medians of
# RUNS (5) rounds, in which all take turns, on two threads; ratios are what counts.
#
#     tests/bench/convert.sh BUILD DIRECTORY     files DIRECTORY/*.exr, eight a field of 525i
set -eu
build=$1 directory=$2 runs=${RUNS:-5}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export OMP_NUM_THREADS=2
files=("$directory"/*.exr)
rate=480000/1001
printf "file '%s'\n" "${files[@]}" >"$work/list"

weft()
{
    "$build/weft" convert "${files[@]}" --subframe-rate $rate -q --threads 2 --overwrite "$@"
}

floor() { "$build"/tests/bench-floor 2 "${files[@]}" >/dev/null; }
width1() { weft --temporal-width 1 -o "$work/a.y4m"; }
width0() { weft --temporal-width 0 -o "$work/a.y4m"; }
ffmpeg_way()
{
    ffmpeg -nostdin -v error -y -threads 2 -f concat -safe 0 -r 480000/1001 -i "$work/list" -vf "
        zscale=720:486:filter=bilinear:matrixin=gbr:rangein=full:matrix=170m:range=limited,
        format=yuv422p10,tmix=frames=8,framestep=8,interlace=lowpass=complex:scan=bff" \
        -c:v v210 -f rawvideo "$work/a.v210"
}

# time_of NAME: seconds of one run, appended to its list.
time_of()
{
    local began
    began=$(date +%s%N)
    "$1"
    echo $(($(date +%s%N) - began)) >>"$work/$1"
}

ways="floor width1 width0"
if command -v ffmpeg >/dev/null; then ways="$ways ffmpeg_way"; else echo "no ffmpeg: left out"; fi
for _ in $(seq "$runs"); do for way in $ways; do time_of "$way"; done; done
median() { sort -n "$work/$1" | awk '{ v[NR] = $1 } END { print v[int((NR + 1) / 2)] / 1e9 }'; }
printf '%-12s %8s %10s %12s\n' "" seconds "x floor" "x width 1"
for way in $ways; do
    awk -v n="$way" -v t="$(median "$way")" -v f="$(median floor)" -v w="$(median width1)" \
        'BEGIN { printf "%-12s %8.3f %10.2f %12.2f\n", n, t, t / f, t / w }'
done
