#!/usr/bin/env bash
# Submits a job array to Slurm that renders a scene, and a job that merges the parts when all tasks have succeeded.
#
#   tools/cluster/submit.sh TASKS SAMPLES OUT.exr SCENE [OPTIONS of etendue render]
#
# The parts are in the folder OUT.parts, which all nodes must share. SBATCH_OPTIONS holds further options of sbatch for
# the array, for example "--cpus-per-task=32 --time=1:00:00".
set -euo pipefail
if [ $# -lt 4 ]; then
  echo "usage: $0 TASKS SAMPLES OUT.exr SCENE [OPTIONS]" >&2
  exit 2
fi
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
tasks=$1
samples=$2
out=$3
shift 3
folder=${out%.exr}.parts
read -r -a options <<<"${SBATCH_OPTIONS:-}"
job=$(SAMPLES=$samples sbatch --parsable "${options[@]}" --array="0-$((tasks - 1))" "$here/render_array.sh" "$folder" "$@")
job=${job%%;*}
sbatch --dependency="afterok:$job" --kill-on-invalid-dep=yes "$here/merge_parts.sh" "$folder" "$samples" "$out"
