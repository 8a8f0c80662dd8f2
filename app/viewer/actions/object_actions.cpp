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

}  // namespace

void add_object_actions(ActionList& actions) {
  add_adding_actions(actions);
  actions.add({.name = "object.duplicate",
               .menu = "Edit",
               .label = "Duplicate",
               .tooltip = "Copies the selected object with its children. The copy uses the same meshes and materials",
               .shortcut = "ctrl+d",
               .run = duplicate_selected,
               .enabled = has_selected_node,
               .section = "object"});
  actions.add({.name = "object.delete",
               .menu = "Edit",
               .label = "Delete",
               .tooltip = "Removes the selected object with its children",
               .shortcut = "delete",
               .run = delete_selected,
               .enabled = has_selected_node,
               .section = "object"});
  actions.add({.name = "object.hide",
               .menu = "Edit",
               .label = "Hide or show",
               .tooltip = "Hides the selected object with its children, or shows it. Hidden objects are not rendered",
               .shortcut = "shift+h",
               .run = toggle_visibility_of_selected,
               .enabled = has_selected_node,
               .section = "object"});
  actions.add({.name = "light.solo",
               .menu = "Edit",
               .label = "Solo light",
               .tooltip = "Hides all other lights, or shows them again. Emissive surfaces and the environment stay",
               .run = solo_selected_light,
               .enabled = is_light_selected,
               .checked = is_solo,
               .section = "object"});
}

}  // namespace etendue::viewer
