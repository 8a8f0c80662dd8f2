// Edits of the objects of the scene: add, duplicate, delete, rename, hide and show. Each is one step of undo.
#pragma once
#include <string>
#include <vector>

#include "base/result.h"
#include "scene/forward.h"

namespace etendue::render {
struct Document;
}
namespace etendue::scene {
struct Transform;
}

namespace etendue::viewer {

struct AppState;

// Add an object near the centre of orbits, in a size that suits the scene, and select it. `type` is a type of light, or
// a shape of scene::shape_types().
void add_light(AppState& state, const std::string& type);
void add_shape(AppState& state, const std::string& type);
// Adds a camera with position and lens of the current view.
void add_camera(AppState& state);

// All selected nodes, the active one (Selection::node) last; and those whose ancestors are not selected.
std::vector<int> selected_nodes(const AppState& state);
std::vector<int> selected_roots(const AppState& state);
bool is_selected(const AppState& state, int node);
// Adds a node to the selection, or removes it. An added node is the active one.
void toggle_selected(AppState& state, int node, int material);

// These apply to all selected nodes, and do nothing without one. Names are those of the active node.
void duplicate_selected(AppState& state);
void delete_selected(AppState& state);
void rename_selected(AppState& state, const std::string& name);
void toggle_visibility_of_selected(AppState& state);

// Makes nodes children of a node, or roots if it is -1. Their places in the world stay.
void set_parent(AppState& state, const std::vector<int>& nodes, int parent);
// The other selected nodes become children of the active one.
void parent_selected(AppState& state);
void unparent_selected(AppState& state);
bool can_parent_selected(const AppState& state);
bool can_unparent_selected(const AppState& state);  // one of them has a parent

// The nodes of the scene that have a light and that were not removed.
const std::vector<int>& light_nodes(const AppState& state);
// Hides all lights except the selected one, or shows all if the others are hidden already.
void solo_selected_light(AppState& state);
bool is_light_selected(const AppState& state);
bool is_solo(const AppState& state);

// Keyframes at the present time. Setting one keeps the present place of each selected object.
void set_keyframe(AppState& state);
void remove_keyframe(AppState& state);
bool can_set_keyframe(const AppState& state);
bool has_keyframe(const AppState& state);
// The times of the keyframes of the selected object, in seconds.
std::vector<float> selected_keyframes(const AppState& state);
// A document with this keyframe at its time.
Result<render::Document> with_keyframe_at_present(const render::Document& document, int node,
                                                  const scene::Transform& transform);

// Clears the parts of the selection that the document does not have, for instance after undo.
void drop_stale_selection(AppState& state);

}  // namespace etendue::viewer
