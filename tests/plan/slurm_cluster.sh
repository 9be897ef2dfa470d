# shellcheck shell=bash
# A Slurm cluster of three nodes on this machine, for the scripts that source this in the place of script.sh,
# which it sources: it ends with the script. `within 20 idle` waits until it is there, `within 60 over` until
# all jobs are done.
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
