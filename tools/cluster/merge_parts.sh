#!/usr/bin/env bash
# The job after a job array: makes the image from its parts.
#
#   sbatch --dependency=afterok:ARRAY_JOB tools/cluster/merge_parts.sh FOLDER SAMPLES OUT.exr
#
# Fails with a message that names what is missing if the parts do not have all SAMPLES samples.
#SBATCH --job-name=etendue-merge
#SBATCH --output=%x-%j.log
set -euo pipefail
etendue=${ETENDUE:-etendue}
if [ $# -ne 3 ]; then
  echo "usage: $0 FOLDER SAMPLES OUT.exr" >&2
  exit 2
fi
exec "$etendue" merge "$1"/part-*.exr --spp "$2" -o "$3"
