#include "viewer/viewport/object_icons.h"

#include <imgui.h>

#include <algorithm>
#include <vector>

#include "camera/segment_projection.h"
#include "render/document.h"
#include "viewer/panels/panel.h"
#include "viewer/state/app_state.h"
#include "viewer/state/object_edits.h"
#include "viewer/widgets/object_shapes.h"

namespace etendue::viewer {
namespace {

constexpr float kIconRadius = 8;    // pixels at scale 1
constexpr size_t kMostIcons = 500;  // more would hide the image
constexpr ImU32 kIconColor = IM_COL32(255, 225, 120, 255);
constexpr ImU32 kCameraColor = IM_COL32(190, 215, 255, 255);
constexpr ImU32 kIconBackground = IM_COL32(0, 0, 0, 160);

struct ObjectIcon {
  int node = -1;
  Vec2 position{0};
  bool is_light = false;
};

std::vector<ObjectIcon> icons_of(const AppState& state) {
  const render::Document& d = state.document();
  const NodePlaces::Places& places = state.viewport.node_places.of(d.scene);
  const Placement& image = state.viewport.image;
  std::vector<ObjectIcon> icons;
  for (size_t i = 0; i < std::min(places.with_icon.size(), kMostIcons); ++i) {
    const auto node = static_cast<size_t>(places.with_icon[i]);
    const Vec3 position(places.world[node][3]);
    // The camera of the view is at its own position.
    if (position == Vec3(d.camera.to_world[3])) continue;
    const auto ends = project_segment(d.camera, Vec2i(image.size), position, position);
    if (ends) icons.push_back({static_cast<int>(node), image.corner + (*ends)[0], d.scene->nodes[node].light >= 0});
  }
  return icons;
}

}  // namespace

void draw_object_icons(AppState& state, ImDrawList& draw) {
  const float r = kIconRadius * state.ui.scale;
  for (const ObjectIcon& icon : icons_of(state)) {
    if (!state.viewport.region.contains(icon.position)) continue;
    state.ui.items.add("icon." + std::to_string(icon.node), Placement{icon.position - r, Vec2(2 * r)});
    const bool visible = state.document().scene->nodes[static_cast<size_t>(icon.node)].visible;
    const ImU32 color = visible ? (icon.is_light ? kIconColor : kCameraColor) : IM_COL32(150, 150, 150, 255);
    draw.AddCircleFilled({icon.position.x, icon.position.y}, r * 1.15f, kIconBackground);
    if (is_selected(state, icon.node))
      draw.AddCircle({icon.position.x, icon.position.y}, r * 1.3f, IM_COL32(120, 190, 240, 255), 0, 2);
    draw_object_shape(draw, icon.is_light ? ObjectKind::light : ObjectKind::camera, icon.position, r, color);
  }
}

int icon_at(const AppState& state, Vec2 position) {
  if (!state.interface.visible || !state.viewport.show_icons) return -1;
  const float r = kIconRadius * state.ui.scale;
  for (const ObjectIcon& icon : icons_of(state))
    if (glm::length(icon.position - position) <= r) return icon.node;
  return -1;
}

bool select_icon_at(AppState& state, Vec2 position) {
  const int node = icon_at(state, position);
  if (node < 0) return false;
  state.select(node, -1);
  const Panel* open = state.panels.open_tab();
  const bool shows_scene = open && std::string_view(open->info().name) == "tab.scene";
  const bool is_light = state.document().scene->nodes[static_cast<size_t>(node)].light >= 0;
  if (Panel* panel = state.panels.find("tab.light"); panel && is_light && !shows_scene) state.panels.open(*panel);
  return true;
}

}  // namespace etendue::viewer
