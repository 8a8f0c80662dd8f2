#!/usr/bin/env bash
# Builds the tests with sanitizers, runs them, and prints a summary with the names of failed tests.
#
#   tools/sanitizers.sh [asan|tsan|all] [CTEST ARGUMENTS...]    default: all, with the whole suite
#   JOBS=1 tools/sanitizers.sh asan -L fast                     one preset and one label, on one core
#
# Needs clang++-16 and libclang-rt-16-dev.
#
# asan: address, leak and undefined behaviour sanitizers. tsan: thread sanitizer. The logs are
# build/PRESET/sanitizers.log. Exit code 1 means that a test failed or that a preset could not be built.
set -uo pipefail
cd "$(dirname "$0")/.."
which=${1:-all}
[ $# -eq 0 ] || shift
jobs=${JOBS:-$(nproc)}
case $which in
  asan | tsan) presets=$which ;;
  all) presets="asan tsan" ;;
  *) echo "usage: tools/sanitizers.sh [asan|tsan|all] [CTEST ARGUMENTS...]" >&2; exit 2 ;;
esac

failed=0
summary=""
for preset in $presets; do
  log=build/$preset/sanitizers.log
  mkdir -p "build/$preset"
  start=$(date +%s)
  if ! { cmake --preset "$preset" && cmake --build "build/$preset" -j "$jobs"; } >"$log" 2>&1; then
    tail -n 40 "$log" >&2
    summary+="$preset: not built, see $log"$'\n'
    failed=1
    continue
  fi
  built=$(date +%s)
  ctest --preset "$preset" -j "$jobs" "$@" >>"$log" 2>&1 || failed=1
  summary+="$preset: built in $((built - start)) s, tests ran for $(($(date +%s) - built)) s"$'\n'
  summary+="$(grep -E 'tests passed' "$log" | tail -n 1)"$'\n'
  summary+="$(sed -n '/^The following tests FAILED/,/^Errors while/p' "$log" | grep -E '^\s+[0-9]+ - ')"$'\n'
done
printf '%s' "$summary" | grep -v '^$'
exit $failed
