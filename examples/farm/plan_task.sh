#!/bin/bash
#SBATCH --requeue
#SBATCH --open-mode=append
# What Slurm runs, for plan_queue.py: a command, in which TASK stands for the number of the array's task.
words=()
for word; do
    [ "$word" != TASK ] || word=$SLURM_ARRAY_TASK_ID
    words+=("$word")
done
exec "${words[@]}"
