#!/usr/bin/env bash
# Makes the generated files of assets/ again: environments and sample scenes. $ETENDUE is the program; the default is the
# release build.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
program=$(realpath "${ETENDUE:-$root/build/release/app/cli/etendue}")
mkdir -p "$root/assets/environments" "$root/assets/scenes"
for name in studio overcast sunset; do "$program" save "$name" -o "$root/assets/environments/$name.hdr"; done
for name in cornell cornell-spheres glossy-plates; do "$program" save "$name" -o "$root/assets/scenes/$name.glb"; done
