#!/usr/bin/env bash
# Pictures of the interface: interface_screenshots.sh OUT [WIDTHxHEIGHT [GROUP...]]    default: 1280x720, all groups
#
# Writes OUT/NAME.png with the Cornell box in the off-screen viewer. The groups: `menus` (with submenus and dialogs), `panels`
# (with tooltips), `contexts` (context menus), `combos` (and colour pickers), `viewport`, `questions` (and notices).
# OUT/sheet.png has all pictures of the run if the test program `looks` is built. $ETENDUE is the program; the default is the
# release build.
set -euo pipefail
[ $# -ge 1 ] || { sed -n 2,7p "$0" >&2; exit 2; }
root=$(cd "$(dirname "$0")/.." && pwd)
program=$(realpath "${ETENDUE:-$root/build/release/app/cli/etendue}")
mkdir -p "$1"
out=$(realpath "$1")
size=${2:-1280x720}
groups=("${@:3}")
[ ${#groups[@]} -gt 0 ] || groups=(menus panels contexts combos viewport questions)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# A material library and a folder of snapshots of their own.
export HOME=$work
unset XDG_DATA_HOME XDG_STATE_HOME XDG_CONFIG_HOME
steps=()
names=()

key() { printf '{"do": "key", "key": "%s"}' "$1"; }
text() { printf '{"do": "type", "text": "%s"}' "$1"; }
click() { printf '{"do": "click", "item": "%s"}' "$1"; }
menu_of() { printf '{"do": "click", "item": "%s", "button": "right"}' "$1"; }
# A click of the middle button only moves the pointer there.
hover() { printf '{"do": "click", "item": "%s", "button": "middle"}' "$1"; }
assign() { printf '{"do": "set", "name": "%s", "value": %s}' "$1" "$2"; }
pause() { printf '{"do": "wait", "seconds": %s}' "$1"; }

# picture NAME STEP...: the steps, a moment, and a picture.
picture() {
  local name=$1
  shift
  steps+=("$@" "$(pause 0.4)" "{\"do\": \"screenshot\", \"file\": \"$out/$name.png\"}")
  names+=("$name")
}
# tooltip NAME ITEM
tooltip() { picture "tooltip-$1" "$(hover "$2")" "$(pause 0.8)"; }
# popup NAME STEP...: a picture of something that Escape closes.
popup() {
  picture "$@"
  steps+=("$(key escape)")
}

# view ARGUMENT...: runs the steps with an image that is soon complete, so that the processors draw the interface.
view() {
  local start=("$(assign render.samples 16)" "$(assign film.width 480)" "$(assign film.height 360)" '{"do": "wait", "spp": 16}')
  (IFS=,; printf '[%s]\n' "${start[*]},${steps[*]}") >"$work/script.json"
  "$program" view --offscreen --size "$size" --script "$work/script.json" "$@"
  steps=()
}

# The entries of the program's list that begin like this.
listed() { "$program" list widgets --json | grep -oE "\"name\": \"$1[a-z.-]+\"" | cut -d '"' -f 4; }
submenus() {
  "$program" list widgets --json |
    awk -F '"' '/"menu":/ { menu = $4 } /"submenu":/ { if ($4 != "") print tolower(menu "/" $4) }' | sort -u
}

take_menus() {
  for menu in file edit view compare integrator render help; do popup "menu-$menu" "$(click "menu.$menu")"; done
  while read -r entry; do
    local menu=${entry%%/*} submenu=${entry#*/}
    popup "submenu-$menu-${submenu// /-}" "$(click "menu.$menu")" "$(click "submenu.$submenu")"
    steps+=("$(key escape)")
  done < <(submenus)
  popup tooltip-menu "$(click menu.file)" "$(hover entry.file.open)" "$(pause 0.8)"
  picture shortcuts "$(key f1)"
  steps+=("$(click help.close)")
  popup palette "$(key ctrl+k)" "$(text exposure)"
  popup palette-nothing "$(key ctrl+k)" "$(text zzz)"
  for dialog in open:ctrl+o export-image:ctrl+e export-scene:ctrl+shift+e save-as:ctrl+shift+s; do
    popup "dialog-${dialog%%:*}" "$(key "${dialog#*:}")"
  done
  popup dialog-load-reference "$(click compare.load-reference)"
  picture welcome "$(click app.welcome)" "$(pause 10)"  # until there are pictures of the scenes
  steps+=("$(click welcome.close)")
  popup preferences "$(key ctrl+,)"
  popup preferences-scales "$(key ctrl+,)" "$(click preferences.scale)"
  picture preferences-keyboard "$(key ctrl+,)" "$(click preferences.keyboard)"
  picture preferences-keyboard-waits "$(click preferences.shortcut.file.new)"
  steps+=("$(key escape)" "$(click preferences.close)")
  view --safe cornell
}

# Each panel, and the tooltip of one of its items.
take_panels() {
  local items="tab.render:render.integrator tab.scene:scene.node.7.visible tab.light:environment.preset
    tab.camera:camera.yfov tab.display:display.curve panel.convergence:compare.seconds panel.sampling:sampling.points
    panel.surface:surface.angle panel.lab:lab.experiment panel.sequence:sequence.samples"
  steps+=("$(click tab.scene)" "$(click scene.node.7)")
  for panel in $(listed 'tab\.') $(listed 'panel\.'); do
    picture "${panel/./-}" "$(click "$panel")"
    for item in $items; do [ "${item%%:*}" != "$panel" ] || tooltip "${panel#*.}" "${item#*:}"; done
  done
  steps+=("$(click tab.material)")
  tooltip material material.5.roughness
  tooltip tab panel.histogram
  tooltip error status.error
  tooltip reliability status.reliability
  picture detached "$(click panel.histogram)" "$(click layout.detach)"
  view --safe cornell
}

take_contexts() {
  popup context-viewport '{"do": "click", "image": [0.5, 0.9], "button": "right"}'
  steps+=("$(click tab.scene)" "$(click scene.node.7)")
  popup context-viewport-selected '{"do": "click", "image": [0.5, 0.9], "button": "right"}'
  popup context-tree "$(click tab.scene)" "$(menu_of scene.node.7)"
  popup context-number "$(click tab.material)" "$(menu_of material.5.roughness)"
  popup context-color "$(menu_of material.5.base-color)"
  popup context-combo "$(click tab.render)" "$(menu_of render.integrator)"
  popup context-toggle "$(menu_of render.adaptive)"
  popup context-tab "$(menu_of tab.render)"
  popup context-bottom-tab "$(menu_of panel.histogram)"
  view --safe cornell
}

take_combos() {
  for combo in render.integrator render.sampler render.error-measure film.filter; do
    popup "combo-${combo/./-}" "$(click tab.render)" "$(click "$combo")"
  done
  popup combo-layer "$(click tab.display)" "$(click view.aov)"
  popup combo-tone-curve "$(click display.curve)"
  popup combo-environment "$(click tab.light)" "$(click environment.preset)"
  popup combo-projection "$(click tab.camera)" "$(click camera.projection)"
  steps+=("$(click tab.scene)" "$(click scene.node.7)")
  popup combo-material "$(click tab.material)" "$(click material.choose)"
  popup combo-presets "$(click material.presets)"
  popup combo-texture "$(click material.texture.add)"
  popup combo-experiment "$(click panel.lab)" "$(click lab.experiment)"
  popup combo-error "$(click panel.lab)" "$(click status.error)"
  steps+=("$(click tab.material)" "$(click material.choose)" "$(click material.choose.3)")
  popup picker-emission "$(click material.3.emission)"
  picture spectrum-emission "$(click material.3.emission-spectrum.edit)"
  steps+=("$(key escape)" "$(click add.light.point)" "$(click tab.light)")
  picture light-point
  popup combo-light-unit "$(click light.unit)"
  popup combo-light-preset "$(click light.preset)"
  view --safe cornell
}

take_viewport() {
  steps+=("$(click tab.scene)" "$(click scene.node.7)")
  picture viewport-gizmo "$(key g)"
  picture viewport-pixel-values "$(key g)" "$(key i)" '{"do": "click", "image": [0.4, 0.4], "button": "middle"}'
  picture viewport-comparison "$(key i)" "$(key c)"
  picture viewport-timeline "$(key c)" "$(click keyframe.set)" "$(assign scene.time 2)" "$(click keyframe.set)"
  picture viewport-region "$(key b)" '{"do": "drag", "from": [200, 250], "to": [380, 360]}'
  picture viewport-only "$(key h)"
  view --safe cornell
}

# A triangle whose materials have images that do not exist.
scene_with_warnings() {
  local names=(wood stone metal cloth) images="" textures="" materials="" primitives=""
  for i in 0 1 2 3; do
    images+="{\"uri\": \"${names[i]}.png\"},"
    textures+="{\"source\": $i},"
    materials+="{\"pbrMetallicRoughness\": {\"baseColorTexture\": {\"index\": $i}}},"
    primitives+="{\"attributes\": {\"POSITION\": 0}, \"material\": $i},"
  done
  local bytes=AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA  # (0, 0, 0), (1, 0, 0), (0, 1, 0)
  cat <<END
{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
 "meshes": [{"primitives": [${primitives%,}]}], "materials": [${materials%,}], "textures": [${textures%,}],
 "images": [${images%,}], "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,$bytes"}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}]}
END
}

take_questions() {
  # A message that arrives while a dialog is open.
  popup notice-dialog "$(key f12)" "$(key ctrl+o)" "$(pause 3)"
  picture notice-message "$(click compare.pin)"
  echo "no glTF" >"$work/damaged.glb"
  picture notice-error "$(key ctrl+o)" "$(click files.name)" "$(key ctrl+a)" "$(text "$work/damaged.glb")" "$(key enter)"
  picture panel-messages-filled "$(click panel.messages)"
  picture question-unsaved "$(assign material.5.roughness 0.5)" "$(key ctrl+q)"
  steps+=("$(click unsaved.cancel)")
  scene_with_warnings >"$work/warnings.gltf"
  picture notice-warnings "{\"do\": \"open\", \"file\": \"$work/warnings.gltf\"}"
  view --safe cornell
  # A viewer that ends without a chance to save its edits.
  local edit=("$(assign material.5.roughness 0.5)" "$(pause 600)")
  (IFS=,; printf '[%s]\n' "${edit[*]}") >"$work/edit.json"
  "$program" view --offscreen --settings "$work/settings" --script "$work/edit.json" cornell &
  local viewer=$!
  while ! compgen -G "$work/settings/recovery/*.etendue" >/dev/null; do sleep 0.2; done
  kill -9 "$viewer"
  wait "$viewer" 2>/dev/null || true
  printf '[%s]\n' "$(pause 1),{\"do\": \"screenshot\", \"file\": \"$out/question-recovery.png\"}" >"$work/script.json"
  "$program" view --offscreen --size "$size" --settings "$work/settings" --script "$work/script.json" cornell
  names+=(question-recovery)
}

for group in "${groups[@]}"; do "take_$group"; done

tiles=()
for name in "${names[@]}"; do tiles+=("$out/$name.png" "$name"); done
looks=$root/build/release/tests/looks
[ ! -x "$looks" ] || "$looks" --pictures "$out/sheet.png" 620 3 "${tiles[@]}"
echo "${#names[@]} pictures in $out"
