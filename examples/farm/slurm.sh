#!/bin/bash
# Converts on a Slurm cluster: an array of N tasks, and a job that joins what they made.
#
#   slurm.sh N OUTPUT INPUT... OPTION...
#
# Prints the two job numbers. Run again after a failure it does only what is missing. WEFT_CPUS is
# how many processors each task asks for (4); partition, account and such come from sbatch's own
# variables, SBATCH_PARTITION=.., SBATCH_ACCOUNT=... WEFT names the program if it is not on the path.
farm=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
. "$farm/common.sh"
[ $# -ge 3 ] || die "usage: slurm.sh N OUTPUT INPUT... OPTION..." 2
begin "$@"
name=${2##*/}

array=$(sbatch --parsable --array="1-$1" --cpus-per-task="${WEFT_CPUS:-4}" --job-name="weft $name" \
    "$farm/slurm_task.sh" "$farm/chunk.sh" "$@") || exit
join=$(sbatch --parsable --dependency="afterok:${array%%;*}" --kill-on-invalid-dep=yes \
    --job-name="join $name" "$farm/slurm_task.sh" "$farm/join.sh" "$@") || exit
echo "${array%%;*} ${join%%;*}"
