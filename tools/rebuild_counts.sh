#!/usr/bin/env bash
# How many translation units a change of each file rebuilds: rebuild_counts.sh BUILD_FOLDER FILE...
# Counts the objects of the last build whose recorded dependencies contain the file.
set -euo pipefail
build=$1; shift
deps=$(mktemp); trap 'rm -f "$deps"' EXIT
ninja -C "$build" -t deps > "$deps"
for file in "$@"; do
  module_path=${file#*/}  # include directories hold one module each: core/bsdf/lobe.h is included as bsdf/lobe.h
  awk -v name="$module_path" '/: #deps/ { seen = 0 }
    { if (!seen && substr($0, length($0) - length(name)) == "/" name) { seen = 1; ++n } }
    END { print n + 0 }' "$deps" | sed "s#\$# $file#"
done
