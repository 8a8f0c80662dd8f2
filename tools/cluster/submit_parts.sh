#!/usr/bin/env bash
# Submits a job array to Slurm that computes etendue bench, stress or figure --all, and a job that merges the parts when
# all tasks have succeeded.
#
#   tools/cluster/submit_parts.sh TASKS OUT COMMAND [ARGUMENTS of the command]
#
# The results are in the folder OUT, the parts in OUT.parts, which all nodes must share. SBATCH_OPTIONS holds further
# options of sbatch for the array, for example "--cpus-per-task=32 --exclusive".
set -euo pipefail
if [ $# -lt 3 ]; then
  echo "usage: $0 TASKS OUT COMMAND [ARGUMENTS]" >&2
  exit 2
fi
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
tasks=$1
out=${2%/}
shift 2
folder=$out.parts
read -r -a options <<<"${SBATCH_OPTIONS:-}"
job=$(sbatch --parsable "${options[@]}" --array="1-$tasks" "$here/part_array.sh" "$folder" "$@")
job=${job%%;*}
sbatch --dependency="afterok:$job" --kill-on-invalid-dep=yes "$here/merge_results.sh" "$folder" "$tasks" "$out"
