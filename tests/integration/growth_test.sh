#!/bin/sh
# Runs tools/growth.py with small sizes: `growth_test.sh PROGRAM SOURCE_FOLDER`. The fit has a known exponent, every kind has
# a chart, and a scene with more triangles takes more memory.
command -v python3 >/dev/null || exit 77
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
set -e
python3 "$2/tools/growth.py" triangles instances lights -o "$folder" --etendue "$1" --largest 60000 --steps 2 --repeats 1 \
  --seconds 0.02 --side 16
python3 "$2/tools/growth.py" threads pixels samples -o "$folder/small" --etendue "$1" --largest 2 --repeats 1 \
  --seconds 0.02 --side 16 --steps 2 2>/dev/null && exit 1  # the largest size is below the smallest
python3 "$2/tools/growth.py" threads -o "$folder/threads" --etendue "$1" --largest 2 --repeats 1 --seconds 0.02 --side 16
python3 "$2/tools/growth.py" pixels samples -o "$folder/image" --etendue "$1" --largest 4096 --steps 2 --repeats 1 \
  --seconds 0.02 --side 16
for chart in triangles instances lights threads/threads image/pixels image/samples; do
  grep -q '</svg>' "$folder/$chart.svg"
done
python3 - "$2" "$folder" <<'END'
import json, pathlib, sys
sys.dont_write_bytecode = True
sys.path.insert(0, sys.argv[1] + "/tools")
import growth
assert abs(growth.exponent([1, 10, 100], [3, 3 * 10 ** 0.5, 30]) - 0.5) < 1e-12
assert growth.exponent([1, 10], [0, 1]) is None
rows = json.loads((pathlib.Path(sys.argv[2]) / "growth.json").read_text())["triangles"]["rows"]
assert rows[1]["size"] == 60000 and rows[1]["memory"] > rows[0]["memory"] + 1, rows
END
