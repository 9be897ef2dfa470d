#!/bin/bash
# examples/farm/slurm.sh on a Slurm cluster of three nodes that this script starts and that ends
# with it; what is joined in the end equals a single run byte for byte. At full length two nodes die in
# mid-job, and Slurm queues their tasks again.

PATH=$PATH:/usr/sbin:/sbin
skip() { echo "skipped: $1"; exit 77; } # before script.sh, which makes a directory
[ -z "${WEFT_SANITIZE:-}" ] || skip "the farm scripts are tried with an ordinary build"
for program in slurmctld slurmd sbatch unshare ip; do
    command -v $program >/dev/null || skip "no $program (packages slurmctld slurmd slurm-client iproute2)"
done

# Namespaces of its own: no port is taken, and whatever was started ends with this script.
if [ -z "${WEFT_INSIDE:-}" ]; then
    new=(unshare --pid --fork --kill-child --mount-proc --net --uts)
    [ "$(id -u)" = 0 ] || new+=(--user --map-root-user)
    "${new[@]}" true 2>/dev/null || skip "namespaces cannot be made here (${new[*]})"
    WEFT_INSIDE=1 exec "${new[@]}" bash "$0"
fi
hostname farm
ip link set lo up
# Names are looked up for address families only that an interface has beyond 127.0.0.1.
ip address add 192.0.2.1/32 dev lo
. "$WEFT_SOURCE/tests/program/script.sh"
farm=$WEFT_SOURCE/examples/farm
export WEFT WEFT_CPUS=1 SLURM_CONF=$work/slurm.conf

# ---- The cluster ----

mkdir state log spool-n1 spool-n2 spool-n3
cat >slurm.conf <<CONF
ClusterName=weft
SlurmctldHost=farm(127.0.0.1)
SlurmctldPort=17817
SlurmUser=root
SlurmdUser=root
AuthType=auth/none
CredType=cred/none
StateSaveLocation=$work/state
SlurmctldPidFile=$work/controller.pid
SlurmdPidFile=$work/%n.pid
SlurmdSpoolDir=$work/spool-%n
ProctrackType=proctrack/pgid
TaskPlugin=task/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerType=sched/builtin
SchedulerParameters=sched_interval=1
SlurmdTimeout=2
MessageTimeout=2
KillWait=1
NodeName=n1 NodeHostname=farm NodeAddr=127.0.0.1 Port=17821 CPUs=1
NodeName=n2 NodeHostname=farm NodeAddr=127.0.0.1 Port=17822 CPUs=1
NodeName=n3 NodeHostname=farm NodeAddr=127.0.0.1 Port=17823 CPUs=1
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF

# within SECONDS COMMAND..: until it succeeds.
within()
{
    local end=$((SECONDS + $1))
    shift
    until "$@"; do
        [ $SECONDS -lt $end ] || { echo "not in time: $*"; squeue -r; tail -n 5 log/*; return 1; }
        sleep 0.02
    done
}

idle() { [ "$(sinfo -h -o %D -t idle 2>/dev/null)" = 3 ]; }

slurmctld -D -c >log/controller 2>&1 &
for node in n1 n2 n3; do slurmd -D -N $node >log/$node 2>&1 & done
disown -a

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

# Slurm notices what is over, or queues tasks of nodes that died again two minutes later, for which there is
# no time here.
over()
{
    local task
    for task in $(squeue -h -r -t PD -o '%i %r' | sed -n 's/ BeginTime//p'); do
        scontrol update jobid="$task" starttime=now
    done
    sleep 0.5
    [ -z "$(squeue -h)" ]
}

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
