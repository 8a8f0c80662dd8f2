#!/usr/bin/env bash
# Efficiency of one build relative to another, on the same scenes: equal_time.sh OLD NEW ENVIRONMENT SCENE...
#
# Efficiency is 1 / (error x processor time of rendering). Both builds render in turn with the same seeds on one thread
# and are compared with a reference of the new build. The table shows the ratio of efficiencies NEW / OLD (median, and
# range over the repeats), and the ratios OLD / NEW of error and of time. The time of a rendering of one sample is
# subtracted. ENVIRONMENT `none` keeps that of the scene. INTEGRATOR, SIZE, SAMPLES, REPEATS, REFERENCE (samples) and
# METRIC (relmse, rmse) can be set in the environment; `rmse` is squared.
set -euo pipefail
old=$1 new=$2 env=$3; shift 3
size=${SIZE:-64x64} samples=${SAMPLES:-48} repeats=${REPEATS:-7} reference=${REFERENCE:-2048}
integrator=${INTEGRATOR:-path} metric=${METRIC:-relmse}
environment=(--env "$env"); [ "$env" = none ] && environment=()
dir=$(mktemp -d); trap 'rm -rf "$dir"' EXIT
TIMEFORMAT=%U
render() { # program, scene, samples, seed, image: prints processor seconds
  { time "$1" render "$2" "${environment[@]}" --integrator "$integrator" --size "$size" --threads 1 --spp "$3" --seed "$4" -o "$5" 2>/dev/null >&2; } 2>&1
}
error() {
  "$new" compare "$1" "$dir/reference.exr" --json | sed -n "s/.*\"$metric\": *\([^,}]*\).*/\1/p" |
    awk -v metric="$metric" '{ print metric == "rmse" ? $1 * $1 : $1 }'
}
echo '| scene | efficiency, new / old | smallest | largest | error, old / new | time, old / new |'
echo '|---|---|---|---|---|---|'
for scene in "$@"; do
  "$new" render "$scene" "${environment[@]}" --integrator "$integrator" --size "$size" --spp "$reference" --seed 1000 -o "$dir/reference.exr" 2>/dev/null >&2
  for seed in $(seq "$repeats"); do
    for build in old new; do
      start=$(render "${!build}" "$scene" 1 "$seed" "$dir/x.exr")
      seconds=$(render "${!build}" "$scene" "$samples" "$seed" "$dir/x.exr")
      echo "$build $(error "$dir/x.exr") $seconds $start"
    done
  done | awk '{ t = $3 - $4; if ($1 == "old") { e = $2; s = t } else print e * s / ($2 * t), e / $2, s / t }' > "$dir/ratios"
  median() { cut -d' ' -f"$1" "$dir/ratios" | sort -g | awk '{ v[NR] = $1 } END { print v[int((NR + 1) / 2)] }'; }
  sort -g "$dir/ratios" | awk -v name="$(basename "$scene" | sed 's/\..*//')" -v m="$(median 1)" -v e="$(median 2)" \
    -v t="$(median 3)" 'NR == 1 { low = $1 } { high = $1 }
      END { printf "| %s | %.2f | %.2f | %.2f | %.2f | %.2f |\n", name, m, low, high, e, t }'
done
