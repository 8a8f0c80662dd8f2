#!/usr/bin/env bash
# Shows scenes as the viewer displays them right after opening, without options: contact_sheet.sh OUT SCENE|FOLDER...
#
#   tools/contact_sheet.sh out/contact-sheet "$ETENDUE_TEST_DATA/gltf"
#
# A folder stands for all glTF files below it, in alphabetical order, except those of the negative tests (Negative).
# Writes one screenshot per scene and OUT/index.html with all of them, and OUT/sheet.png if the test program `looks` is
# built. $ETENDUE is the program; the default is the release build. $SPP samples per pixel are taken (16).
set -euo pipefail
[ $# -ge 2 ] || { sed -n 2,10p "$0" >&2; exit 2; }
program=$(realpath "${ETENDUE:-$(dirname "$0")/../build/release/app/cli/etendue}")
out=$1
shift
scenes=()
for argument in "$@"; do
  if [ -d "$argument" ]; then
    mapfile -d '' -t found < <(find "$argument" -name '*.gl*' ! -path '*/Negative/*' -print0 | sort -z)
    scenes+=("${found[@]}")
  else
    scenes+=("$argument")
  fi
done
mkdir -p "$out"
out=$(realpath "$out")
{
  echo '<!doctype html><meta charset="utf-8"><title>Contact sheet</title>'
  echo '<style>body{font-family:sans-serif;background:#222;color:#ddd}figure{display:inline-block;margin:4px}img{width:420px}</style>'
} >"$out/index.html"
n=0
failed=0
tiles=()
for scene in "${scenes[@]}"; do
  n=$((n + 1))
  name=$(printf %03d "$n")
  cat >"$out/script.json" <<JSON
[{"do": "wait", "spp": ${SPP:-16}}, {"do": "wait", "seconds": 0.3}, {"do": "screenshot", "file": "$out/$name.png"}]
JSON
  if ! timeout 120 "$program" view --offscreen --safe --size 1280x720 --script "$out/script.json" "$scene"; then
    echo "$scene: failed" >&2
    failed=$((failed + 1))
  fi
  tiles+=("$out/$name.png" "$(basename "${scene%.*}")")
  echo "<figure><img src=\"$name.png\"><figcaption>$(basename "$scene")</figcaption></figure>" >>"$out/index.html"
done
rm -f "$out/script.json"
looks=$(dirname "$0")/../build/release/tests/looks
[ ! -x "$looks" ] || "$looks" --pictures "$out/sheet.png" 150 10 "${tiles[@]}"
echo "$out/index.html: $n scenes, $failed failed"
[ "$failed" = 0 ]
