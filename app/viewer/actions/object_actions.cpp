// Objects of the scene: add, duplicate, delete, hide and show.
#include "light/light.h"
#include "scene/structural_edit.h"
#include "viewer/actions/all_actions.h"
#include "viewer/actions/conditions.h"
#include "viewer/state/object_edits.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

bool has_selected_node(const AppState& state) { return state.has_document() && state.selection.node >= 0; }

void add_adding_actions(ActionList& actions) {
  for (const auto& shape : scene::shape_types())
    actions.add({.name = std::string("add.") + shape.name,
                 .menu = "Edit",
                 .label = shape.label,
                 .tooltip = "Adds a " + lower_case(shape.label) + " with a diffuse material of its own",
                 .run = [type = std::string(shape.name)](AppState& state) { add_shape(state, type); },
                 .enabled = has_document,
                 .section = "add",
                 .submenu = "Add shape"});
  for (const LightTypeInfo& type : light_type_infos())
    actions.add({.name = std::string("add.light.") + type.description.name,
                 .menu = "Edit",
                 .label = type.description.label,
                 .tooltip = std::string("Adds a light. ") + type.description.summary,
                 .run = [name = std::string(type.description.name)](AppState& state) { add_light(state, name); },
                 .enabled = has_document,
                 .section = "add",
                 .submenu = "Add light"});
  actions.add({.name = "add.camera",
               .menu = "Edit",
               .label = "Add camera",
               .tooltip = "Adds a camera with the position and the lens of the current view",
               .run = add_camera,
               .enabled = has_document,
               .section = "add"});
}

void add_gizmo(ActionList& actions, GizmoMode mode, const char* name, const char* label, const char* tooltip,
               const char* shortcut) {
  actions.add({.name = name,
               .menu = "Edit",
               .label = label,
               .tooltip = tooltip,
               .shortcut = shortcut,
               .run = [mode](AppState& state) { toggle_gizmo(state, mode); },
               .enabled = has_document,
               .checked = [mode](const AppState& state) { return state.viewport.gizmo.mode == mode; },
               .section = "gizmo"});
}

void add_gizmo_actions(ActionList& actions) {
  add_gizmo(actions, GizmoMode::move, "gizmo.move", "Move",
            "Shows handles that move the selected object along axes and in planes. Ctrl snaps", "g");
  add_gizmo(actions, GizmoMode::rotate, "gizmo.rotate", "Rotate",
            "Shows rings that rotate the selected object about its origin. Ctrl snaps to 15 degrees", "t");
  add_gizmo(actions, GizmoMode::scale, "gizmo.scale", "Scale",
            "Shows handles that scale the selected object along its own axes. Ctrl snaps to tenths", "s");
  actions.add({.name = "gizmo.local",
               .menu = "Edit",
               .label = "Local axes",
               .tooltip = "Handles follow the axes of the object rather than those of the world",
               .shortcut = "shift+g",
               .run = [](AppState& state) { state.viewport.gizmo.local = !state.viewport.gizmo.local; },
               .enabled = has_document,
               .checked = [](const AppState& state) { return state.viewport.gizmo.local; },
               .section = "gizmo"});
}

}  // namespace

void add_object_actions(ActionList& actions) {
  add_adding_actions(actions);
  actions.add({.name = "object.duplicate",
               .menu = "Edit",
               .label = "Duplicate",
               .tooltip = "Copies the selected objects with their children. Copies use the same meshes and materials",
               .shortcut = "ctrl+d",
               .run = duplicate_selected,
               .enabled = has_selected_node,
               .section = "object"});
  actions.add({.name = "object.delete",
               .menu = "Edit",
               .label = "Delete",
               .tooltip = "Removes the selected objects with their children",
               .shortcut = "delete",
               .run = delete_selected,
               .enabled = has_selected_node,
               .section = "object"});
  actions.add({.name = "object.hide",
               .menu = "Edit",
               .label = "Hide or show",
               .tooltip = "Hides the selected objects with their children, or shows them. Hidden objects are not rendered",
               .shortcut = "shift+h",
               .run = toggle_visibility_of_selected,
               .enabled = has_selected_node,
               .section = "object"});
  actions.add({.name = "object.parent",
               .menu = "Edit",
               .label = "Parent",
               .tooltip = "Makes the other selected objects children of the one that was selected last. They keep their "
                          "places",
               .shortcut = "ctrl+p",
               .run = parent_selected,
               .enabled = can_parent_selected,
               .section = "object"});
  actions.add({.name = "object.unparent",
               .menu = "Edit",
               .label = "Unparent",
               .tooltip = "Separates the selected objects from their parents. They keep their places",
               .shortcut = "ctrl+shift+p",
               .run = unparent_selected,
               .enabled = can_unparent_selected,
               .section = "object"});
  actions.add({.name = "light.solo",
               .menu = "Edit",
               .label = "Solo light",
               .tooltip = "Hides all other lights, or shows them again. Emissive surfaces and the environment stay",
               .run = solo_selected_light,
               .enabled = is_light_selected,
               .checked = is_solo,
               .section = "object"});
  actions.add({.name = "keyframe.set",
               .menu = "Edit",
               .label = "Set keyframe",
               .tooltip = "Keeps the place of the selected objects at the present time. Between keyframes they move. Handles "
                          "of an animated object set its keyframe, too",
               .shortcut = "k",
               .run = set_keyframe,
               .enabled = can_set_keyframe,
               .section = "keyframe"});
  actions.add({.name = "keyframe.remove",
               .menu = "Edit",
               .label = "Remove keyframe",
               .tooltip = "Removes the keyframe of the selected object at the present time",
               .shortcut = "shift+k",
               .run = remove_keyframe,
               .enabled = has_keyframe,
               .section = "keyframe"});
  add_gizmo_actions(actions);
}

}  // namespace etendue::viewer
