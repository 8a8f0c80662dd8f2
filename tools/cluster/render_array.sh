#!/usr/bin/env bash
# One task of a Slurm job array: renders its share of the samples of a scene into a part.
#
#   SAMPLES=1024 sbatch --array=0-15 tools/cluster/render_array.sh FOLDER SCENE [OPTIONS of etendue render]
#
# Task i of n renders the samples i*SAMPLES/n to (i+1)*SAMPLES/n and writes FOLDER/part-i.exr. A part that exists is
# complete and is not rendered again, so a failed array can be submitted again as it is. ETENDUE names the program.
#SBATCH --job-name=etendue
#SBATCH --output=%x-%A-%a.log
set -euo pipefail
etendue=${ETENDUE:-etendue}
if [ $# -lt 2 ] || [ -z "${SAMPLES:-}" ]; then
  echo "usage: SAMPLES=N sbatch --array=0-LAST $0 FOLDER SCENE [OPTIONS]" >&2
  exit 2
fi
folder=$1
shift
if [ "${SLURM_ARRAY_TASK_MIN:-0}" -ne 0 ]; then
  echo "$0: the array begins at ${SLURM_ARRAY_TASK_MIN}; give --array=0-LAST" >&2
  exit 2
fi
task=${SLURM_ARRAY_TASK_ID:?is set by sbatch --array}
tasks=$((${SLURM_ARRAY_TASK_MAX:?is set by sbatch --array} + 1))
first=$((SAMPLES * task / tasks))
end=$((SAMPLES * (task + 1) / tasks))
if [ "$first" -eq "$end" ]; then
  echo "$0: $SAMPLES samples are fewer than $tasks tasks" >&2
  exit 2
fi
part=$folder/part-$task.exr
mkdir -p "$folder"
if [ -e "$part" ]; then
  echo "$part exists"
  exit 0
fi
exec "$etendue" render "$@" --samples "$first:$end" --threads "${SLURM_CPUS_PER_TASK:-0}" -o "$part"
