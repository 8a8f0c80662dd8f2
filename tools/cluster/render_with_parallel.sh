#!/usr/bin/env bash
# Renders a scene on several machines with GNU parallel, and merges the parts here. With more parts than machines, fast
# machines render more of them.
#
#   tools/cluster/render_with_parallel.sh HOST,HOST,... PARTS SAMPLES OUT.exr SCENE [OPTIONS of etendue render]
#
# The machines share this folder under the same path. The host ":" is this machine. Each machine renders one part at a
# time. Parts that exist are complete and are not rendered again. ETENDUE names the program.
set -euo pipefail
etendue=${ETENDUE:-etendue}
if [ $# -lt 5 ]; then
  echo "usage: $0 HOST,HOST,... PARTS SAMPLES OUT.exr SCENE [OPTIONS]" >&2
  exit 2
fi
hosts=$1
count=$2
samples=$3
out=$4
shift 4
if ! [ "$count" -ge 1 ] || ! [ "$samples" -ge "$count" ]; then
  echo "$0: $samples samples do not divide into $count parts" >&2
  exit 2
fi
folder=${out%.exr}.parts
mkdir -p "$folder"

parts=()
missing=()
for ((i = 0; i < count; ++i)); do
  part=$folder/part-$i.exr
  parts+=("$part")
  [ -e "$part" ] && continue # complete, from an earlier run
  missing+=("$((samples * i / count)):$((samples * (i + 1) / count)) $part")
done
if [ ${#missing[@]} -gt 0 ]; then
  render=$(printf '%q ' "$etendue" render "$@")
  printf '%s\n' "${missing[@]}" |
    parallel --will-cite --sshlogin "$hosts" --jobs 1 --workdir "$PWD" --colsep ' ' "$render --samples {1} -o {2}" || {
    echo "$0: a part failed; run the command again to render the missing parts" >&2
    exit 1
  }
fi
"$etendue" merge "${parts[@]}" --spp "$samples" -o "$out"
