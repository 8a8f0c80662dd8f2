#!/usr/bin/env bash
# One task of a Slurm job array: computes its part of etendue bench, stress or figure --all.
#
#   sbatch --array=1-16 tools/cluster/part_array.sh FOLDER COMMAND [ARGUMENTS of the command]
#
# Task i of n computes part i/n and writes FOLDER/part-i-of-n.part. A part that exists is complete and is not computed
# again, so a failed array can be submitted again as it is. ETENDUE names the program.
#SBATCH --job-name=etendue
#SBATCH --output=%x-%A-%a.log
set -euo pipefail
etendue=${ETENDUE:-etendue}
if [ $# -lt 2 ]; then
  echo "usage: sbatch --array=1-LAST $0 FOLDER COMMAND [ARGUMENTS]" >&2
  exit 2
fi
folder=$1
shift
if [ "${SLURM_ARRAY_TASK_MIN:-1}" -ne 1 ]; then
  echo "$0: the array begins at ${SLURM_ARRAY_TASK_MIN}; give --array=1-LAST" >&2
  exit 2
fi
task=${SLURM_ARRAY_TASK_ID:?is set by sbatch --array}
tasks=${SLURM_ARRAY_TASK_MAX:?is set by sbatch --array}
part=$folder/part-$task-of-$tasks.part
if [ -e "$part" ]; then
  echo "$part exists"
  exit 0
fi
exec "$etendue" "$@" --part "$task/$tasks" --threads "${SLURM_CPUS_PER_TASK:-0}" --out "$folder"
