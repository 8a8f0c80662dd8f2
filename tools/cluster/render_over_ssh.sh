#!/usr/bin/env bash
# Renders a scene on several machines by ssh, and merges the parts here.
#
#   tools/cluster/render_over_ssh.sh "HOST HOST ..." SAMPLES OUT.exr SCENE [OPTIONS of etendue render]
#
# The machines share this folder under the same path. Each renders an equal share of the samples; a machine that is
# listed twice gets two shares. ETENDUE names the program, SSH the command that runs a command line on a machine.
set -euo pipefail
etendue=${ETENDUE:-etendue}
ssh=${SSH:-ssh}
if [ $# -lt 4 ]; then
  echo "usage: $0 \"HOST HOST ...\" SAMPLES OUT.exr SCENE [OPTIONS]" >&2
  exit 2
fi
read -r -a hosts <<<"$1"
samples=$2
out=$3
shift 3
folder=${out%.exr}.parts
mkdir -p "$folder"

jobs=()
parts=()
for i in "${!hosts[@]}"; do
  first=$((samples * i / ${#hosts[@]}))
  end=$((samples * (i + 1) / ${#hosts[@]}))
  part=$folder/part-$i.exr
  parts+=("$part")
  [ -e "$part" ] && continue # complete, from an earlier run
  command=$(printf '%q ' cd "$PWD")
  command+="&& $(printf '%q ' "$etendue" render "$@" --samples "$first:$end" -o "$part")"
  $ssh "${hosts[$i]}" "$command" &
  jobs+=($!)
done
failed=0
for job in "${jobs[@]}"; do wait "$job" || failed=1; done
if [ "$failed" -ne 0 ]; then
  echo "$0: a machine failed; run the command again to render the missing parts" >&2
  exit 1
fi
"$etendue" merge "${parts[@]}" --spp "$samples" -o "$out"
