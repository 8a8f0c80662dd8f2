#!/usr/bin/env bash
# Regenerates docs/manual from the program and its sources: update_manual.sh [--images]. Rendering the images takes some minutes.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
etendue=${ETENDUE:-$root/build/release/app/cli/etendue}
cd "$root"
find docs/manual -name '*.md' -delete 2>/dev/null || true
"$etendue" manual docs/manual --source . "$@"
if [ "${1:-}" = --images ]; then
  "$etendue" manual docs/manual --source .  # pages of cases that have an image now
  command -v optipng >/dev/null && optipng -quiet docs/manual/images/*.png
fi
