#!/usr/bin/env bash
# Drives the window on a virtual display with a real pointer and keyboard: orbits, switches the integrator, saves a
# snapshot, quits. The snapshot must contain these changes and render again without a display.
# Usage: window_test.sh ETENDUE_BINARY
set -euo pipefail
etendue=$1
for tool in xvfb-run xdotool; do
  command -v "$tool" >/dev/null || { echo "skipped: there is no $tool"; exit 77; }  # the value that CTest counts as skipped
done
if [ -z "${ETENDUE_WINDOW_TEST:-}" ]; then
  ETENDUE_WINDOW_TEST=1 exec xvfb-run -a -s "-screen 0 1400x900x24" "$0" "$@"
fi
folder=$(mktemp -d)
trap 'kill "${viewer:-}" 2>/dev/null || true; rm -rf "$folder"' EXIT
export HOME=$folder XDG_CONFIG_HOME=$folder XDG_STATE_HOME=$folder XDG_DATA_HOME=$folder XDG_CACHE_HOME=$folder
cd "$folder"

"$etendue" cornell & viewer=$!
window=$(timeout 30 xdotool search --sync --onlyvisible --name "tendue" | head -1)
sleep 1
xdotool windowfocus "$window" mousemove --window "$window" 300 400 mousedown 1
for x in 320 340 360 380 400; do xdotool mousemove --window "$window" "$x" 390; sleep 0.05; done
xdotool mouseup 1
sleep 0.3
xdotool key --window 0 3
sleep 1
xdotool key --window 0 F12
for _ in $(seq 50); do [ -n "$(find . -name '*.exr')" ] && break; sleep 0.1; done
sleep 0.3
xdotool key --window 0 ctrl+q
for _ in $(seq 100); do kill -0 "$viewer" 2>/dev/null || break; sleep 0.1; done
if kill -0 "$viewer" 2>/dev/null; then echo "the window is still open" >&2; exit 1; fi
wait "$viewer"
viewer=

snapshot=$(find . -name '*.exr' | head -1)
"$etendue" render --like "$snapshot" --spp 1 --size 32x32 -o again.exr --json stats.json
grep -q '"integrator": *"path-pure"' stats.json
# The camera went round: its state is not the built-in one.
"$etendue" render cornell --spp 1 --size 32x32 --integrator path-pure -o straight.exr
mse=$("$etendue" compare again.exr straight.exr --json | sed -n 's/.*"mse": *\([0-9.e+-]*\).*/\1/p')
echo "mean squared difference to the view that was left: $mse"
awk -v mse="$mse" 'BEGIN { exit !(mse > 1e-3) }'
