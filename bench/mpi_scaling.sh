#!/usr/bin/env bash
# Processor time of a rendering by 1, 2 and 4 ranks on this machine, and the cost of MPI with one rank.
#
#   bench/mpi_scaling.sh [build/release/app/cli/etendue [short]]
#
# "short" leaves out the instruction counts.
#
# Processor time is the sum over all ranks and mpirun, so other programs on the machine hardly change it; wall-clock time
# is meaningful on a machine that does nothing else. A rank has one thread. Needs perf and valgrind.
set -euo pipefail
etendue=$(realpath "${1:-build/release/app/cli/etendue}")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
mpirun=(mpirun --oversubscribe --bind-to none)
scene=(render cornell --size 480x270 --seed 5 --threads 1 -o out.exr)

# Milliseconds of processor time and of wall-clock time of a command.
times() {
  perf stat -x, -e task-clock,duration_time -o time.csv "$@" >log.txt 2>&1
  awk -F, '/task-clock/ { printf "%.0f ", $1 } /duration_time/ { printf "%.0f", $1 / 1e6 }' time.csv
}
echo "strong scaling: 512 samples per pixel in all; processor and wall-clock time in ms"
for ranks in 1 2 4; do
  echo "$ranks $(times "${mpirun[@]}" -n $ranks "$etendue" "${scene[@]}" --spp 512) $(grep -h 'rank.* rendered' log.txt)"
done
echo "weak scaling: 160 samples per pixel and rank; processor and wall-clock time in ms"
for ranks in 1 2 4; do
  echo "$ranks $(times "${mpirun[@]}" -n $ranks "$etendue" "${scene[@]}" --spp $((160 * ranks)))"
done
echo "one rank against a process without MPI, 128 samples per pixel, in turns; processor and wall-clock time in ms"
for _ in 1 2 3 4; do
  echo "$(times "$etendue" "${scene[@]}" --spp 128) $(times "${mpirun[@]}" -n 1 "$etendue" "${scene[@]}" --spp 128)"
done
[ "${2:-}" = short ] && exit 0
echo "instructions with 4 and 8 samples per pixel: without MPI, with one rank"
for samples in 4 8; do
  plain=$(valgrind --tool=callgrind --callgrind-out-file=calls.out "$etendue" "${scene[@]}" --spp $samples 2>&1 |
    awk '/Collected/ { print $NF }')
  rank=$("${mpirun[@]}" -n 1 valgrind --tool=callgrind --callgrind-out-file=calls.out "$etendue" "${scene[@]}" \
    --spp $samples 2>&1 | awk '/Collected/ { print $NF }')
  echo "$samples $plain $rank"
done
