#!/usr/bin/env bash
# Makes the screenshots of the documentation again: update_screenshots.sh [NAME...]
#
# Runs assets/scripts/screenshots/NAME.json, without names all of them, in the off-screen viewer and writes
# docs/images/viewer/NAME.png. $ETENDUE is the program; the default is the release build. pngquant and optipng reduce
# the size of the files if they are installed.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
program=$(realpath "${ETENDUE:-$root/build/release/app/cli/etendue}")
scripts=$root/assets/scripts/screenshots
images=$root/docs/images/viewer
mkdir -p "$images"
# The scripts use a material library and a folder of snapshots of their own.
HOME=$(mktemp -d)
export HOME
unset XDG_DATA_HOME XDG_STATE_HOME XDG_CONFIG_HOME
mkdir "$HOME/Pictures"
trap 'rm -rf "$HOME"' EXIT
# Scripts name the screenshot without a folder.
cd "$images"
if [ $# -eq 0 ]; then
  for script in "$scripts"/*.json; do set -- "$@" "$(basename "$script" .json)"; done
fi
for name in "$@"; do
  "$program" view --offscreen --size "${SIZE:-1280x720}" --script "$scripts/$name.json"
  if command -v pngquant > /dev/null; then pngquant --force --ext .png 256 "$name.png"; fi
  if command -v optipng > /dev/null; then optipng -quiet "$name.png"; fi
  echo "docs/images/viewer/$name.png: $(stat -c %s "$name.png") bytes"
done
