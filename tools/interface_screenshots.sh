#!/usr/bin/env bash
# Pictures of every menu, dialog and panel of the viewer: interface_screenshots.sh OUT [WIDTHxHEIGHT]    default: 1280x720
#
# Writes OUT/NAME.png with the Cornell box in the off-screen viewer, and OUT/sheet.png with all of them if the test program
# `looks` is built. $ETENDUE is the program; the default is the release build.
set -euo pipefail
[ $# -ge 1 ] || { sed -n 2,5p "$0" >&2; exit 2; }
root=$(cd "$(dirname "$0")/.." && pwd)
program=$(realpath "${ETENDUE:-$root/build/release/app/cli/etendue}")
mkdir -p "$1"
out=$(realpath "$1")
size=${2:-1280x720}
steps=('{"do": "wait", "spp": 16}')
names=()

# picture NAME STEP...: the steps, a moment, and a picture.
picture() {
  local name=$1
  shift
  steps+=("$@" '{"do": "wait", "seconds": 0.4}' "{\"do\": \"screenshot\", \"file\": \"$out/$name.png\"}")
  names+=("$name")
}
key() { printf '{"do": "key", "key": "%s"}' "$1"; }
click() { printf '{"do": "click", "item": "%s"}' "$1"; }

for menu in file edit view compare integrator render help; do
  picture "menu-$menu" "$(click "menu.$menu")"
  steps+=("$(key escape)")
done
picture shortcuts "$(key f1)"
steps+=("$(click help.close)")
picture palette "$(key ctrl+k)" '{"do": "type", "text": "exposure"}'
steps+=("$(key escape)")
for dialog in preferences:ctrl+, open:ctrl+o export-image:ctrl+e export-scene:ctrl+shift+e save-as:ctrl+shift+s; do
  picture "dialog-${dialog%%:*}" "$(key "${dialog#*:}")"
  steps+=("$(key escape)")
done
# The panels of the registry.
panels=$("$program" list widgets --json | grep -oE '"view\.(tab|panel)\.[a-z]+"' | tr -d '"' | sed 's/^view\.//')
for panel in $panels; do picture "${panel/./-}" "$(click "$panel")"; done

script=$(mktemp --suffix=.json)
trap 'rm -f "$script"' EXIT
(IFS=,; printf '[%s]\n' "${steps[*]}") >"$script"
"$program" view --offscreen --safe --size "$size" --script "$script" cornell
tiles=()
for name in "${names[@]}"; do tiles+=("$out/$name.png" "$name"); done
looks=$root/build/release/tests/looks
[ ! -x "$looks" ] || "$looks" --pictures "$out/sheet.png" 620 3 "${tiles[@]}"
echo "${#names[@]} pictures in $out"
