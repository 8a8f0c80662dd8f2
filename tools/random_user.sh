#!/usr/bin/env bash
# The random user with a sanitizer: pointer and keyboard events at random in the off-screen viewer, with scenes of
# surfaces, of glass and of a medium, in windows of several sizes, and with files that are dropped on the window.
#
#   tools/random_user.sh [asan|tsan|release] [ACTIONS] [FIRST SEED]    default: asan 10000 1
#
# Builds the preset if necessary; the sanitizers need clang++-16 and libclang-rt-16-dev. Each run has at most 500 actions,
# so that a finding can be repeated quickly: run N uses the seed FIRST + N. Exit code 0 means that no run had a finding.
# The logs are build/PRESET/random-user/N.log (actions) and N.txt (output). $ETENDUE is a program to use instead. Test
# data (ETENDUE_TEST_DATA) adds files to drop.
set -uo pipefail
cd "$(dirname "$0")/.."
preset=${1:-asan}
actions=${2:-10000}
first=${3:-1}
case $preset in
  asan | tsan | release) ;;
  *) sed -n 2,11p "$0" >&2; exit 2 ;;
esac
program=${ETENDUE:-build/$preset/app/cli/etendue}
if [ -z "${ETENDUE:-}" ]; then
  mkdir -p "build/$preset"
  if ! { cmake --preset "$preset" && cmake --build "build/$preset" --target etendue; } >"build/$preset/random-user.log" 2>&1; then
    tail -n 40 "build/$preset/random-user.log" >&2
    exit 1
  fi
fi
out=$PWD/build/$preset/random-user
rm -rf "$out"
mkdir -p "$out/drop"

export LSAN_OPTIONS=suppressions=$PWD/cmake/lsan.supp:print_suppressions=0
export TSAN_OPTIONS=suppressions=$PWD/cmake/tsan.supp:halt_on_error=1
export UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1

# Files to drop: scenes, an environment, a session, pictures, and files that cannot be opened.
data=${ETENDUE_TEST_DATA:-../shared/data}
"$program" save cornell-spheres -o "$out/drop/spheres.glb" >/dev/null || exit 1
"$program" save sunset -o "$out/drop/sunset.hdr" >/dev/null || exit 1
"$program" render cornell --size 32x32 --spp 1 -o "$out/drop/snapshot.exr" --png "$out/drop/picture.png" >/dev/null || exit 1
head -c 200 "$out/drop/spheres.glb" >"$out/drop/cut.glb"
echo "not a scene" >"$out/drop/text.txt"
for file in gltf/Box.glb gltf/AnimatedMorphCube.glb gltf/UnlitTest.glb; do
  [ ! -f "$data/$file" ] || cp "$data/$file" "$out/drop/"
done
files=$(find "$out/drop" -type f | sort | sed 's/.*/"&"/' | paste -sd, -)

# The leaks in a report that count. Memory that code without a module allocated (llvmpipe generates code at run time) does
# not, because cmake/lsan.supp cannot name such code.
own_leaks() {
  awk '/^(Direct|Indirect) leak of/ { leak = $0; waits = 1; next }
       waits && /^ *#[0-9]+ / && !/__interceptor_|libsanitizer|operator new| (malloc|calloc|realloc|posix_memalign) / {
         waits = 0
         if (!/<unknown module>/) print leak " " $0
       }' "$1"
}

# Whether an exit code 1 comes from such leaks only.
is_foreign_leak() {
  grep -q 'ERROR: LeakSanitizer' "$1" && ! grep -qE 'ERROR: AddressSanitizer|runtime error|^etendue: ' "$1" &&
    [ -z "$(own_leaks "$1")" ]
}

scenes=(cornell glass-caustic fog many-lights prism)
small='{"do": "set", "name": "film.width", "value": 240}, {"do": "set", "name": "film.height", "value": 180},
  {"do": "set", "name": "render.samples", "value": 8},'
sizes=(800x600 1024x600 800x600 1280x720)
done=0
failed=0
run=0
while [ "$done" -lt "$actions" ]; do
  count=$((actions - done < 500 ? actions - done : 500))
  seed=$((first + run))
  scene=${scenes[$((run % ${#scenes[@]}))]}
  size=${sizes[$((run % ${#sizes[@]}))]}
  # Three of four runs begin with an image that is soon complete, so that the processors are free for the interface.
  start=
  [ "$size" = 1280x720 ] || start=$small
  cat >"$out/$run.json" <<JSON
[$start
 {"do": "random", "seed": $seed, "actions": $count, "files": [$files], "log": "$out/$run.log"}]
JSON
  code=0
  "$program" view --offscreen --size "$size" --settings "$out/settings-$run" --script "$out/$run.json" "$scene" >"$out/$run.txt" 2>&1 || code=$?
  echo "$scene $size: seed $seed, $count actions, exit code $code"
  if [ "$code" = 1 ] && is_foreign_leak "$out/$run.txt"; then
    echo "  only leaks of code without a module"
    code=0
  fi
  [ "$code" = 0 ] || { failed=$((failed + 1)); tail -n 20 "$out/$run.txt"; }
  done=$((done + count))
  run=$((run + 1))
done
echo "$done actions in $run runs, $failed with findings"
[ "$failed" = 0 ]
