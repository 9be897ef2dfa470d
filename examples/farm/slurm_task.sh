#!/bin/bash
#SBATCH --requeue
#SBATCH --open-mode=append
# What Slurm runs, for slurm.sh: chunk.sh in an array, join.sh after it. Slurm runs a copy of this
# file, which is why it is told where the others are. A task whose node failed is queued again
# (--requeue), and adds to the log that it began.
program=$1
shift
[ -z "${SLURM_ARRAY_TASK_ID:-}" ] || set -- "$SLURM_ARRAY_TASK_ID" "$@"
echo "${program##*/} $1 on ${SLURMD_NODENAME:-}, restart ${SLURM_RESTART_COUNT:-0}"
export WEFT_THREADS=${SLURM_CPUS_ON_NODE:-all}
exec "$program" "$@"
