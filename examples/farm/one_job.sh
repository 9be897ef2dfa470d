#!/bin/bash
# Runs job I of a list, for jobs.sh: one_job.sh I COMMAND --job LIST.json OPTION... What was degraded (frames
# held) is told in the log, and counts as done.
number=$1
shift
"${WEFT:-weft}" "$@" --only "$number" ${WEFT_THREADS:+--threads "$WEFT_THREADS"} --progress plain
code=$?
[ $code = 3 ] && echo "job $number is done, but degraded" && exit 0
exit $code
