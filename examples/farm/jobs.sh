#!/bin/bash
# Runs the jobs of a list (--job) on a farm, a task a job.
#
#   jobs.sh slurm|parallel|here COMMAND LIST.json OPTION...
#
# COMMAND is convert, render or trace. With --resume among the options it can be given again after a
# failure and does the rest; a job that fails does not stop the others. "slurm" prints the number of the
# array; "parallel" runs on this machine, or on those of PARALLEL='--sshlogin a,b,c --workdir .'; "here" is
# one weft, with one report. WEFT names the program if it is not on the path.
farm=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
die() { echo "jobs.sh: $1" >&2; exit "$2"; }
[ $# -ge 3 ] || die "usage: jobs.sh slurm|parallel|here COMMAND LIST.json OPTION..." 2
export WEFT=${WEFT:-weft}
how=$1 command=$2 list=$3
shift 3
[ -r "$list" ] || die "$list: no such file can be read; give the list of jobs" 2
count=$(python3 -c '
import json, sys
jobs = json.load(open(sys.argv[1], encoding="utf-8-sig"))
print(len(jobs if isinstance(jobs, list) else jobs["jobs"]))' "$list" 2>/dev/null) || count=0
[ "$count" -gt 0 ] || die "$list: this is no list of jobs; it is {\"jobs\": [{\"inputs\": .., \"output\": ..}, ..]}" 2

case $how in
slurm)
    sbatch --parsable --array="1-$count" --cpus-per-task="${WEFT_CPUS:-4}" --job-name="weft ${list##*/}" \
        "$farm/slurm_task.sh" "$farm/one_job.sh" "$command" --job "$list" "$@" ;;
parallel)
    seq "$count" | parallel --quote --line-buffer --tagstring "job {}" --env WEFT \
        "$farm/one_job.sh" {} "$command" --job "$list" "$@" || die "jobs failed, as told above; mend that and run this again with --resume" 1 ;;
here)
    exec "$WEFT" "$command" --job "$list" "$@" ;;
*)
    die "$how: it is slurm, parallel or here" 2 ;;
esac
