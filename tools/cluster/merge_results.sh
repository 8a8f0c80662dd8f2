#!/usr/bin/env bash
# The job after a job array of part_array.sh: makes the results from the parts.
#
#   sbatch --dependency=afterok:ARRAY_JOB tools/cluster/merge_results.sh FOLDER TASKS OUT
#
# Fails with a message that names what is missing if a part does not exist.
#SBATCH --job-name=etendue-merge
#SBATCH --output=%x-%j.log
set -euo pipefail
etendue=${ETENDUE:-etendue}
if [ $# -ne 3 ]; then
  echo "usage: $0 FOLDER TASKS OUT" >&2
  exit 2
fi
exec "$etendue" merge "$1"/part-*-of-"$2".part -o "$3"
