#!/usr/bin/env bash
# What dividing a rendering of about a minute costs: one process, one rank of MPI, and two parts that are merged.
#
#   bench/division_overhead.sh [build/release/app/cli/etendue [REPEATS [SIZE [SPP]]]]
#
# The three are measured in turns, REPEATS times (3). Prints seconds of wall-clock time and of processor time, each with
# all threads of the machine, and the overhead relative to one process. Run it on a machine that does nothing else.
set -euo pipefail
etendue=$(realpath "${1:-build/release/app/cli/etendue}")
repeats=${2:-3} size=${3:-1280x720} spp=${4:-256}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
scene=(render cornell --size "$size" --seed 5)
half=$((spp / 2))

#   measure NAME COMMAND...: a line "NAME wall processor" in times.txt.
measure() {
  local name=$1
  shift
  TIMEFORMAT="$name %R %U %S"
  { time "$@" >log.txt 2>&1; } 2>>times.txt || { cat log.txt >&2; exit 1; }
}

for _ in $(seq "$repeats"); do
  rm -f ./*.exr
  measure one "$etendue" "${scene[@]}" --spp "$spp" -o one.exr
  measure rank mpirun --bind-to none -n 1 "$etendue" "${scene[@]}" --spp "$spp" -o rank.exr
  measure parts "$etendue" "${scene[@]}" --samples "0:$half" -o a.exr
  measure parts "$etendue" "${scene[@]}" --samples "$half:$spp" -o b.exr
  measure merge "$etendue" merge a.exr b.exr -o merged.exr
done
"$etendue" compare one.exr merged.exr | grep -i -m1 rmse
du -k a.exr b.exr one.exr

awk -v repeats="$repeats" '
  { wall[$1] += $2 / repeats; processor[$1] += ($3 + $4) / repeats }
  function row(text, w, p) {
    printf "%-24s %8.2f s %8.2f s   %+6.2f %% %+6.2f %%\n", text, w, p, 100 * w / wall["one"] - 100, 100 * p / processor["one"] - 100
  }
  END {
    print "                           wall   processor      overhead"
    row("one process", wall["one"], processor["one"])
    row("one rank", wall["rank"], processor["rank"])
    row("two parts and merging", wall["parts"] + wall["merge"], processor["parts"] + processor["merge"])
    printf "merging alone: %.2f s, %.2f %% of one process; processor time %.2f s, %.2f %%\n", wall["merge"],
      100 * wall["merge"] / wall["one"], processor["merge"], 100 * processor["merge"] / processor["one"]
  }' times.txt
