#!/usr/bin/env bash
# Regenerates docs/manual from the program and its sources: update_manual.sh [--images | --new-images].
# Rendering all images takes some minutes; --new-images renders those that do not exist.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
etendue=${ETENDUE:-$root/build/release/app/cli/etendue}
cd "$root"
find docs/manual -name '*.md' -delete 2>/dev/null || true
"$etendue" manual docs/manual --source . "$@"
if [ $# -gt 0 ]; then
  "$etendue" manual docs/manual --source .  # pages of cases that have an image now
  command -v optipng >/dev/null && optipng -quiet docs/manual/images/*.png
fi
