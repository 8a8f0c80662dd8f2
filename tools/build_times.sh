#!/usr/bin/env bash
# The slowest steps of the last build, in seconds of wall time: build_times.sh BUILD_FOLDER [COUNT]
set -euo pipefail
awk -F'\t' 'NR > 1 { if ($2 > 0) time[$4] = ($2 - $1) / 1000 }
  END { for (f in time) { printf "%8.1f  %s\n", time[f], f; total += time[f] } printf "%8.1f  total\n", total }' \
  "$1/.ninja_log" | sort -rn | head -n "${2:-30}"
