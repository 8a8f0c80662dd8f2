#!/usr/bin/env bash
# Runs all fuzz targets under libFuzzer with the address and undefined behaviour sanitizers, one after the other, and
# prints a table of inputs and findings. The number of inputs of a target follows from its speed.
#
#   tools/fuzz.sh [RUNS | SECONDSs] [TARGET...]    default: 1000000 runs in all; "600s" is 600 seconds in all
#
# Seeds are built in and taken from the test data (ETENDUE_TEST_DATA). The corpus grows in build/fuzz/corpus and is used
# again by the next run. Inputs of findings are kept in build/fuzz/findings; a target reproduces one with
# build/fuzz/tests/integration/fuzz/fuzz_TARGET FILE. Exit code 1 means that there were findings. Needs clang++-16 and
# libclang-rt-16-dev.
set -euo pipefail
cd "$(dirname "$0")/.."
total=${1:-1000000}
[ $# -eq 0 ] || shift
data=${ETENDUE_TEST_DATA:-../shared/data}
programs=build/fuzz/tests/integration/fuzz
corpus=build/fuzz/corpus
findings=build/fuzz/findings

# Target, share of the runs in percent, size limit of an input in bytes.
targets="path 10 256
ies 5 2048
nvdb 2 1048576
hdr 11 4096
png 15 4096
jpeg 13 4096
webp 10 4096
brdf 13 4096
exr 2 8192
script 4 4096
settings 1 4096
oiio 1 8192
state 1 4096
material 1 4096
part 1 8192
glb 4 32768
gltf 6 32768"

# Files of the test data that a target reads: small, because an input takes time in proportion to its size.
files_of() {
  case $1 in
    gltf) find "$data/gltf" "$data/gltf-invalid" -name '*.gltf' -size -16k && find_glb ;;
    glb) find_glb ;;
    hdr | exr | png | webp) find "$data" -name "*.$1" -size -4k ;;
    jpeg) find "$data" -name '*.jpg' -size -4k ;;
  esac
}
find_glb() { find "$data/gltf" "$data/gltf-invalid" -name '*.glb' -size -24k; }

[ -f build/fuzz/build.ninja ] || cmake --preset fuzz >/dev/null
cmake --build build/fuzz --target fuzz_targets >build/fuzz/build.log || { tail -n 40 build/fuzz/build.log >&2; exit 1; }
export ASAN_OPTIONS=allocator_may_return_null=0:detect_leaks=1
export ETENDUE_PLUGIN_PATH=$PWD/build/fuzz/app/cli
export LSAN_OPTIONS=suppressions=$PWD/cmake/lsan.supp:print_suppressions=0
mkdir -p "$findings"

sum=0
failed=0
printf '%-8s %10s %9s %9s\n' target inputs seconds findings
while read -r target share most; do
  [ $# -eq 0 ] || [[ " $* " == *" $target "* ]] || continue
  # Without NanoVDB its target does not exist.
  [ -x "$programs/fuzz_$target" ] || { printf '%-8s %10s\n' "$target" "not built"; continue; }
  case $total in
    *s) limit=-max_total_time=$((${total%s} * share / 100 + 1)) ;;
    *) limit=-runs=$((total * share / 100)) ;;
  esac
  if [ ! -d "$corpus/$target" ] && [ -d "$data" ]; then
    files_of "$target" | sort | tr '\n' '\0' | xargs -0 "$programs/fuzz_$target" --write-corpus "$corpus/$target"
  elif [ ! -d "$corpus/$target" ]; then
    "$programs/fuzz_$target" --write-corpus "$corpus/$target"
  fi
  log=build/fuzz/$target.log
  start=$(date +%s)
  code=0
  "$programs/fuzz_$target" "$limit" -max_len="$most" -timeout=60 -rss_limit_mb=6144 -malloc_limit_mb=6144 \
    -artifact_prefix="$findings/$target-" -print_final_stats=1 "$corpus/$target" >"$log" 2>&1 || code=$?
  inputs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log" | tail -n 1)
  sum=$((sum + ${inputs:-0}))
  [ "$code" = 0 ] || failed=$((failed + 1))
  printf '%-8s %10s %9s %9s\n' "$target" "${inputs:-?}" $(($(date +%s) - start)) \
    "$([ "$code" = 0 ] && echo 0 || echo "1 (see $log)")"
done <<<"$targets"
printf '%-8s %10s %9s %9s\n' all "$sum" "" "$failed"
[ "$failed" = 0 ]
