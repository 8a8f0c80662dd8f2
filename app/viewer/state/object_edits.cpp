#include "viewer/state/object_edits.h"

#include <algorithm>
#include <cmath>

#include "light/light.h"
#include "render/session.h"
#include "scene/compiled_scene.h"
#include "scene/keyframes.h"
#include "scene/pose.h"
#include "scene/rotation.h"
#include "scene/structural_edit.h"
#include "viewer/panels/object_names.h"
#include "viewer/panels/panel.h"
#include "viewer/state/app_state.h"
#include "viewer/state/document_info.h"
#include "viewer/state/editor.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

using scene::EditKind;
using scene::StructuralEdit;

constexpr float kShapeSize = 0.15f;       // half the size of a new shape, relative to the radius of the scene
constexpr float kLightHeight = 0.4f;      // of a new light above the centre of orbits, relative to the same
constexpr float kDuplicateOffset = 0.1f;  // of a copy from the original, relative to the same

const scene::Scene& scene_of(const AppState& state) { return *state.document().scene; }

float scene_radius(const AppState& state) {
  const auto compiled = state.session->scene();
  const float radius = compiled && !compiled->bounds().empty() ? compiled->bounds().radius() : 1.0f;
  return radius > 0 ? radius : 1.0f;
}

// "sphere", "sphere 2", ...: the first name that no node has.
std::string free_name(const scene::Scene& scene, const std::string& base) {
  for (size_t i = 1;; ++i) {
    const std::string name = i == 1 ? base : base + " " + std::to_string(i);
    if (std::ranges::find(scene.nodes, name, &scene::Node::name) == scene.nodes.end()) return name;
  }
}

std::string node_name_of(const scene::Scene& scene, int node) {
  return object_name(scene.nodes[static_cast<size_t>(node)].name, "node", static_cast<size_t>(node));
}

std::string selected_name(const AppState& state) { return node_name_of(scene_of(state), state.selection.node); }

// "box", or "3 objects".
std::string names_of(const AppState& state, const std::vector<int>& nodes) {
  return nodes.size() == 1 ? node_name_of(scene_of(state), nodes.front()) : std::to_string(nodes.size()) + " objects";
}

bool has_ancestor_in(const scene::Scene& scene, int node, const std::vector<int>& nodes) {
  for (int i = scene.nodes[static_cast<size_t>(node)].parent; i >= 0; i = scene.nodes[static_cast<size_t>(i)].parent)
    if (std::ranges::find(nodes, i) != nodes.end()) return true;
  return false;
}

// The document after the edit; an error becomes a message.
std::optional<render::Document> edited(AppState& state, const render::Document& document,
                                       const StructuralEdit& edit) {
  auto changed = render::with_structural_edit(document, edit);
  if (changed) return std::move(*changed);
  state.notices.add_error(changed.error().message);
  return std::nullopt;
}

void assign(render::Document& document, const std::string& name, double value) {
  if (const auto parameter = document_parameter(document, name))
    parameter->assign(document, std::clamp(value, parameter->info.min, parameter->info.max));
}

// Applies an edit that adds an object, and selects it.
void add_object(AppState& state, const StructuralEdit& edit, render::Document changed) {
  const int node = static_cast<int>(scene_of(state).nodes.size());
  state.edit(std::move(changed), "Add " + edit.name);
  state.select(node, -1);
}

// Illuminates the centre of orbits with pi lux at perpendicular incidence.
void set_intensity_of_new_light(render::Document& document, float distance) {
  const size_t index = document.scene->lights.size() - 1;
  const LightClass light_class = document.scene->lights[index].info().description.light_class;
  const std::string name = "light." + std::to_string(index) + ".intensity";
  if (light_class == LightClass::delta_position) assign(document, name, static_cast<double>(kPi * distance * distance));
  if (light_class == LightClass::delta_direction) assign(document, name, static_cast<double>(kPi));
}

}  // namespace

void add_light(AppState& state, const std::string& type) {
  if (!state.has_document()) return;
  const float height = kLightHeight * scene_radius(state);
  const float half = std::sqrt(0.5f);
  StructuralEdit edit{.kind = EditKind::add_light, .type = type, .name = free_name(scene_of(state), type + " light")};
  // The light emits downwards: its -z axis points along -y.
  edit.transform.rotation = Vec4(-half, 0, 0, half);
  edit.transform.translation = state.viewport.camera_controller.pivot() + Vec3(0, height, 0);
  auto changed = edited(state, state.document(), edit);
  if (!changed) return;
  set_intensity_of_new_light(*changed, height);
  add_object(state, edit, std::move(*changed));
}

void add_shape(AppState& state, const std::string& type) {
  if (!state.has_document()) return;
  const float size = kShapeSize * scene_radius(state);
  StructuralEdit edit{.kind = EditKind::add_shape, .type = type, .name = free_name(scene_of(state), type)};
  const bool is_flat = type == "plane" || type == "disk";
  // A shape stands on the surface at the centre of orbits; flat ones are slightly above it.
  edit.transform.translation = state.viewport.camera_controller.pivot() + Vec3(0, is_flat ? 0.02f * size : size, 0);
  edit.transform.scale = Vec3(size);
  if (auto changed = edited(state, state.document(), edit)) add_object(state, edit, std::move(*changed));
}

void add_camera(AppState& state) {
  if (!state.has_document()) return;
  const Camera& view = state.document().camera;
  const auto transform = scene::decompose({.matrix = view.to_world});
  if (!transform) return;
  StructuralEdit edit{.kind = EditKind::add_camera, .name = free_name(scene_of(state), "camera")};
  edit.transform = *transform;
  edit.transform.scale = Vec3(1);
  edit.camera = view;
  if (auto changed = edited(state, state.document(), edit)) add_object(state, edit, std::move(*changed));
}

std::vector<int> selected_nodes(const AppState& state) {
  std::vector<int> nodes = state.selection.others;
  if (state.selection.node >= 0) nodes.push_back(state.selection.node);
  return nodes;
}

std::vector<int> selected_roots(const AppState& state) {
  const std::vector<int> nodes = selected_nodes(state);
  std::vector<int> roots;
  for (const int node : nodes)
    if (!has_ancestor_in(scene_of(state), node, nodes)) roots.push_back(node);
  return roots;
}

bool is_selected(const AppState& state, int node) {
  return node >= 0 && (state.selection.node == node || std::ranges::count(state.selection.others, node) > 0);
}

void toggle_selected(AppState& state, int node, int material) {
  std::vector<int> nodes = selected_nodes(state);
  const bool removes = std::erase(nodes, node) > 0;
  const int active = removes ? (nodes.empty() ? -1 : nodes.back()) : node;
  std::erase(nodes, active);
  state.select(active, removes ? -1 : material);
  state.selection.others = std::move(nodes);
  drop_stale_selection(state);
}

void duplicate_selected(AppState& state) {
  const std::vector<int> originals = selected_roots(state);
  std::optional<render::Document> changed = state.document();
  std::vector<int> copies;
  for (const int original : originals) {
    const scene::Scene& scene = *changed->scene;
    const std::string base = node_name_of(scene, original);
    copies.push_back(static_cast<int>(scene.nodes.size()));
    changed = edited(state, *changed,
                     {.kind = EditKind::duplicate, .node = original, .name = free_name(scene, base)});
    if (!changed) return;
    const std::string parameter = "node." + std::to_string(copies.back()) + ".translation.x";
    if (const auto x = document_parameter(*changed, parameter))
      assign(*changed, parameter,
             std::get<double>(x->info.default_value) + static_cast<double>(kDuplicateOffset * scene_radius(state)));
  }
  if (copies.empty()) return;
  state.edit(std::move(*changed), "Duplicate " + names_of(state, originals));
  state.select(copies.back(), -1);
  state.selection.others.assign(copies.begin(), copies.end() - 1);
}

void delete_selected(AppState& state) {
  const std::vector<int> nodes = selected_roots(state);
  if (nodes.empty()) return;
  const bool is_view =
      std::ranges::count(nodes, scene::node_of_camera(scene_of(state), state.document().camera)) > 0;
  const std::string name = names_of(state, nodes);
  std::optional<render::Document> changed = state.document();
  for (const int node : nodes) {
    changed = edited(state, *changed, {.kind = EditKind::remove, .node = node});
    if (!changed) return;
  }
  state.edit(std::move(*changed), "Delete " + name);
  drop_stale_selection(state);
  state.notices.add_message(is_view ? "Deleted the camera " + name + ". The view stays." : "Deleted " + name);
}

void set_parent(AppState& state, const std::vector<int>& nodes, int parent) {
  const std::string name = names_of(state, nodes);
  std::optional<render::Document> changed = state.document();
  for (const int node : nodes) {
    const scene::Scene& scene = *changed->scene;
    if (scene.nodes[static_cast<size_t>(node)].parent == parent) continue;
    const std::vector<Mat4> world = scene::world_matrices(scene);
    const Mat4 parent_to_world = parent < 0 ? Mat4(1) : world[static_cast<size_t>(parent)];
    if (scene::is_singular(parent_to_world))
      return state.notices.add_error("The transform of the parent has no inverse, so the object cannot keep its place");
    const Mat4 local = glm::inverse(parent_to_world) * world[static_cast<size_t>(node)];
    StructuralEdit edit{.kind = EditKind::set_parent, .node = node, .parent = parent};
    if (const auto parts = scene::decompose({.matrix = local}))
      edit.transform = *parts;
    else
      edit.transform.matrix = local;
    changed = edited(state, *changed, edit);
    if (!changed) return;
  }
  if (changed->scene == state.document().scene) return;
  state.edit(std::move(*changed), (parent < 0 ? "Unparent " : "Parent ") + name);
}

bool can_parent_selected(const AppState& state) { return state.has_document() && !state.selection.others.empty(); }

void parent_selected(AppState& state) {
  if (can_parent_selected(state)) set_parent(state, state.selection.others, state.selection.node);
}

bool can_unparent_selected(const AppState& state) {
  return state.has_document() && std::ranges::any_of(selected_nodes(state), [&](int node) {
           return scene_of(state).nodes[static_cast<size_t>(node)].parent >= 0;
         });
}

void unparent_selected(AppState& state) {
  if (const auto nodes = selected_nodes(state); !nodes.empty()) set_parent(state, nodes, -1);
}

void rename_selected(AppState& state, const std::string& name) {
  if (state.selection.node < 0) return;
  const std::string old = selected_name(state);
  if (auto changed = edited(state, state.document(), {.kind = EditKind::rename, .node = state.selection.node, .name = name}))
    state.edit(std::move(*changed), "Rename " + old);
}

void toggle_visibility_of_selected(AppState& state) {
  const std::vector<int> nodes = selected_nodes(state);
  if (nodes.empty()) return;
  const bool visible = scene_of(state).nodes[static_cast<size_t>(state.selection.node)].visible;
  render::Document changed = state.document();
  auto scene = std::make_shared<scene::Scene>(*changed.scene);
  for (const int node : nodes) scene->nodes[static_cast<size_t>(node)].visible = !visible;
  changed.scene = std::move(scene);
  state.edit(std::move(changed), (visible ? "Hide " : "Show ") + names_of(state, nodes));
}

const std::vector<int>& light_nodes(const AppState& state) {
  return state.viewport.node_places.of(state.document().scene).lights;
}

bool is_light_selected(const AppState& state) {
  return state.has_document() && state.selection.node >= 0 &&
         scene_of(state).nodes[static_cast<size_t>(state.selection.node)].light >= 0;
}

bool is_solo(const AppState& state) {
  if (!is_light_selected(state)) return false;
  const auto& scene = scene_of(state);
  return light_nodes(state).size() > 1 && std::ranges::none_of(light_nodes(state), [&](int node) {
    return node != state.selection.node && scene.nodes[static_cast<size_t>(node)].visible;
  });
}

void solo_selected_light(AppState& state) {
  if (!is_light_selected(state)) return;
  const bool shows_others = is_solo(state);
  render::Document changed = state.document();
  auto scene = std::make_shared<scene::Scene>(*changed.scene);
  for (const int node : light_nodes(state))
    scene->nodes[static_cast<size_t>(node)].visible = shows_others || node == state.selection.node;
  changed.scene = std::move(scene);
  state.edit(std::move(changed), shows_others ? "Show all lights" : "Solo " + selected_name(state));
}

Result<render::Document> with_keyframe_at_present(const render::Document& document, int node,
                                                  const scene::Transform& transform) {
  StructuralEdit edit{.kind = EditKind::set_keyframe, .node = node, .transform = transform};
  edit.animation = scene::animation_for_keyframes(*document.scene, node);
  edit.time = document.scene->time;
  return render::with_structural_edit(document, edit);
}

bool can_set_keyframe(const AppState& state) { return state.has_document() && state.selection.node >= 0; }

void set_keyframe(AppState& state) {
  const std::vector<int> nodes = selected_nodes(state);
  render::Document changed = state.document();
  for (const int node : nodes) {
    const scene::Scene& scene = *changed.scene;
    if (const std::string obstacle = scene::keyframe_obstacle(scene, node); !obstacle.empty())
      return state.notices.add_error(node_name_of(scene, node) + ": " + obstacle);
    const auto transform = scene::decompose(scene::posed_transform(scene, node));
    if (!transform) return state.notices.add_error(node_name_of(scene, node) + ": its transform has no inverse");
    auto keyed = with_keyframe_at_present(changed, node, *transform);
    if (!keyed) return state.notices.add_error(node_name_of(scene, node) + ": " + keyed.error().message);
    changed = std::move(*keyed);
  }
  if (!nodes.empty()) state.edit(std::move(changed), "Set keyframe of " + names_of(state, nodes));
}

std::vector<float> selected_keyframes(const AppState& state) {
  if (!can_set_keyframe(state)) return {};
  const scene::Scene& scene = scene_of(state);
  return scene::keyframe_times(scene, state.selection.node, scene::animation_for_keyframes(scene, state.selection.node));
}

bool has_keyframe(const AppState& state) {
  const auto times = selected_keyframes(state);
  return std::ranges::any_of(times, [&](float time) {
    return std::abs(time - scene_of(state).time) <= scene::kKeyframeTolerance;
  });
}

void remove_keyframe(AppState& state) {
  if (!has_keyframe(state)) return;
  const int node = state.selection.node;
  StructuralEdit edit{.kind = EditKind::remove_keyframe, .node = node};
  edit.animation = scene::animation_for_keyframes(scene_of(state), node);
  edit.time = scene_of(state).time;
  if (auto changed = edited(state, state.document(), edit))
    state.edit(std::move(*changed), "Remove keyframe of " + selected_name(state));
}

void drop_stale_selection(AppState& state) {
  Selection& selection = state.selection;
  if (!state.has_document()) {
    selection = {};
    return;
  }
  const auto& scene = scene_of(state);
  const std::vector<bool>& exists = state.viewport.node_places.of(state.document().scene).exists;
  const auto is_stale = [](int index, size_t count) { return index >= 0 && static_cast<size_t>(index) >= count; };
  const auto is_stale_node = [&](int node) {
    return is_stale(node, scene.nodes.size()) || (node >= 0 && !exists[static_cast<size_t>(node)]);
  };
  std::erase_if(selection.others, is_stale_node);
  if (is_stale_node(selection.node)) {
    selection.node = selection.others.empty() ? -1 : selection.others.back();
    if (selection.node >= 0) selection.others.pop_back();
  }
  if (selection.material >= 0 && !scene::has_material(scene, selection.material)) selection.material = -1;
  const auto shows_light = [&](int node) { return scene.nodes[static_cast<size_t>(node)].light == selection.light; };
  if (is_stale(selection.light, scene.lights.size()) ||
      (selection.light >= 0 && std::ranges::none_of(light_nodes(state), shows_light)))
    selection.light = -1;
}

}  // namespace etendue::viewer
