#!/usr/bin/env bash
# Draws the module graph of a configured build as docs/images/modules.svg. Edges that follow from others are left out. Needs
# Graphviz.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
modules=${1:-build/release/tests/modules.txt}
{
  echo 'digraph modules {'
  echo '  rankdir=BT; bgcolor=transparent; nodesep=0.25; ranksep=0.4;'
  echo '  node [shape=box, style="rounded,filled", fillcolor="#eef3f8", color="#7a8ca0", fontname="sans-serif", fontsize=12];'
  echo '  edge [color="#7a8ca0", arrowsize=0.7];'
  while IFS='|' read -r name folder depends internal; do
    [ -n "$name" ] || continue
    case $folder in lab/*) color='#f8f1e4' ;; *) color='#eef3f8' ;; esac
    echo "  \"$name\" [fillcolor=\"$color\"];"
    for other in ${depends//,/ } ${internal//,/ }; do echo "  \"$name\" -> \"$other\";"; done
  done < "$modules"
  echo '}'
} | tred | dot -Tsvg > docs/images/modules.svg
