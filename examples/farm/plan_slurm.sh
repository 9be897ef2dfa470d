#!/bin/bash
# Renders by a plan and converts on a Slurm cluster: steps that wait for each other.
#
#   plan_slurm.sh N ROUNDS FOLDER OUTPUT COMMAND PLAN_OPTION...
#
# One job lists what `weft plan PLAN_OPTION...` wants, an array of N tasks renders it by COMMAND (plan.py says
# how it is called), and so on for ROUNDS rounds, which is 1 unless --error among the options refines: then 8
# are mostly enough, and one that finds nothing wanted takes no time. The last job converts FOLDER to OUTPUT.
# Prints the numbers of all jobs. When a task fails, what waits for it is canceled: give the command again,
# and it goes on from what is there. WEFT_CPUS is how many processors a task asks for (4).
farm=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
. "$farm/common.sh"
[ $# -ge 6 ] || die "usage: plan_slurm.sh N ROUNDS FOLDER OUTPUT COMMAND PLAN_OPTION..." 2
check_numbers "$1" "$2"
parts=$1 rounds=$2 folder=$3 output=$4 command=$5
shift 5
mkdir -p "$folder" || die "cannot make $folder"
after=() jobs=()

# queue NAME OPTION.. -- COMMAND..: a step that waits for the one before.
queue()
{
    local name=$1 options=() job
    shift
    while [ "$1" != -- ]; do options+=("$1"); shift; done
    shift
    job=$(sbatch --parsable --kill-on-invalid-dep=yes "${after[@]}" "${options[@]}" --job-name="$name ${folder##*/}" \
        "$farm/plan_task.sh" "$@") || exit
    after=(--dependency="afterok:${job%%;*}")
    jobs+=("${job%%;*}")
}

# Of the plan's options those that convert takes too: the size is the files', frames are the output's.
looks=()
words=("$@")
for ((i = 0; i < ${#words[@]}; i += 2)); do
    case ${words[i]} in
    --frames) looks+=(--output-frames "${words[i + 1]}") ;;
    --size | --samples-a-pixel | --scene-fps | --error) ;;
    *) looks+=("${words[i]}" "${words[i + 1]}") ;;
    esac
done

for ((i = 1; i <= rounds; i++)); do
    queue "list $i" -- python3 "$farm/plan.py" list "$folder" "$@"
    queue "render $i" --array="1-$parts" --cpus-per-task="${WEFT_CPUS:-4}" -- \
        python3 "$farm/plan.py" render TASK "$parts" "$folder" "$command"
done
queue convert --cpus-per-task="${WEFT_CPUS:-4}" -- "$weft" convert "$folder" "${looks[@]}" --overwrite \
    --progress plain -o "$output"
echo "${jobs[@]}"
