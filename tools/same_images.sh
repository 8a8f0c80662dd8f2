#!/usr/bin/env bash
# Renders with two builds and compares the images bit for bit: same_images.sh OLD NEW
set -euo pipefail
old=$1 new=$2; dir=$(mktemp -d); trap 'rm -rf "$dir"' EXIT; bad=0
check() { # name, arguments
  local name=$1; shift
  "$old" render "$@" -o "$dir/old.exr" 2>/dev/null || { echo "old failed: $name"; return; }
  "$new" render "$@" -o "$dir/new.exr" 2>/dev/null || { echo "new failed: $name"; bad=1; return; }
  local mse; mse=$("$new" compare "$dir/new.exr" "$dir/old.exr" --json | tr ',' '\n' | grep '"mse"' | sed 's/.*: *//;s/}//')
  case $mse in 0|0.0) ;; *) echo "differs: $name mse $mse"; bad=1 ;; esac
}
scenes=${SCENES:-"cornell cornell-spheres glossy-plates caustic-pool many-lights"}
for integrator in $("$new" list integrators --json | grep '^    "name"\|^  *"name": "[a-z]*[a-z-]*",\?$' | sed 's/.*: "//;s/".*//' | sort -u); do
  "$old" render cornell --integrator "$integrator" --size 8x8 --spp 1 -o "$dir/x.exr" 2>/dev/null || continue
  for scene in $scenes; do check "$integrator $scene" "$scene" --integrator "$integrator" --size 48x40 --spp 6 --seed 3; done
  check "$integrator paths" cornell-spheres --integrator "$integrator" --size 32x32 --spp 4 --paths 'E(D|G|S)(D|G|S)+L'
  check "$integrator ward" cornell --integrator "$integrator" --size 32x32 --spp 4 --set material.0.model=ward --set material.1.model=cook-torrance
done
exit $bad
