#!/bin/bash
# examples/farm/slurm.sh on a Slurm cluster of three nodes that this script starts and that ends
# with it; what is joined in the end equals a single run byte for byte. At full length two nodes die in
# mid-job, and Slurm queues their tasks again.

source "$(dirname "$0")/../plan/slurm_cluster.sh"
farm=$WEFT_SOURCE/examples/farm

# ---- What is converted: pictures over and over ----

frames=6
is_long && frames=32
subframes made 32
mkdir "in put" single farmed
for ((k = 0; k < 16 * frames; k++)); do
    ln -s "../made/subframe.$(printf %04d $((k % 32))).exr" "in put/a b.$(printf %04d $k).exr"
done
from=("in put/a b.####.exr" --subframe-rate 480000/1001)
weft convert "${from[@]}" -o "single/my shot.y4m" || exit 1
within 20 idle || exit 1

if ! is_long; then
    read -r video join <<<"$("$farm/slurm.sh" 2 "farmed/my shot.y4m" "${from[@]}")"
    check "submitted" test -n "$join"
    check "all is done" within 60 over
    check "Y4M is that of a single run" cmp "single/my shot.y4m" "farmed/my shot.y4m"
    check "and nothing else is left" diff -r single farmed
    [ $failed = 0 ] || tail -n 20 slurm-*.out log/*
    finish
    exit
fi

# ---- Nodes that die ----

weft convert "${from[@]}" --frames 0-255 -o "single/f.####.dpx" || exit 1

# The step of a task's log and node, once it runs; then how far it is.
runs() { grep -q " on n[0-9]" "$1" 2>/dev/null; }
advanced() { grep -q " frames (" "$1"; }

# dies LOG: the node of the task that writes LOG goes with all its processes, when the task has made
# frames and before it has made all.
dies()
{
    local node job step groups
    within 60 runs "$1" || return
    node=$(sed -n 's/.* on \(n[0-9]\),.*/\1/p' "$1")
    job=$(squeue -h -w "$node" -t R -o %A)
    step=$(pgrep -f "^slurmstepd: \[$job\.batch\]")
    groups=$(pgrep -P "$step" | sed 's/^/-/')
    within 60 advanced "$1" || return
    # shellcheck disable=SC2086
    kill -9 -- "$(cat "$node.pid")" "$step" $groups || return
    echo "$node died with $(tail -n 1 "$1")"
}

frames() { (cd farmed && stat -c '%n %i %Y' f.*.dpx 2>/dev/null); }

# ---- The farm ----

read -r video join <<<"$("$farm/slurm.sh" 4 "farmed/my shot.y4m" "${from[@]}")"
check "submitted" test -n "$join"
check "a node dies that makes Y4M" dies "slurm-${video}_2.out"
check "in mid-job" test ! -e "farmed/my shot.y4m.parts/2of4.y4m"
check "and its part is not done" test ! -e "farmed/my shot.y4m.parts/2of4.done"
read -r pictures join <<<"$("$farm/slurm.sh" 4 "farmed/f.####.dpx" "${from[@]}" --frames 0-255)"
check "submitted" test -n "$join"
check "a node dies that makes DPX" dies "slurm-${pictures}_1.out"
frames >before
check "in mid-job" test "$(wc -l <before)" -ge 1 -a "$(grep -c 'f.000[0-3]' before)" -lt 4

check "all is done" within 120 over
check "the task of Y4M was queued again" grep -q "restart 1" "slurm-${video}_2.out"
check "the task of DPX was queued again" grep -q "restart 1" "slurm-${pictures}_1.out"
check "Y4M is that of a single run" cmp "single/my shot.y4m" "farmed/my shot.y4m"
check "and nothing else is left" diff -r single farmed
frames >after
check "no frame was made twice" test -z "$(comm -23 before after)"
check "what is there is not made again" exits 1 "$farm/slurm.sh" 4 "farmed/my shot.y4m" "${from[@]}"
check "and that is said" says "exists"

[ $failed = 0 ] || tail -n 20 slurm-*.out log/*
finish
