// Materials: new, duplicate, delete, copy, paste, assign, save to the library.
#include "viewer/actions/all_actions.h"
#include "viewer/actions/conditions.h"
#include "viewer/state/material_edits.h"

namespace etendue::viewer {

void add_material_actions(ActionList& actions) {
  const auto add = [&](const char* name, const char* label, const char* tooltip, void (*run)(AppState&),
                       bool (*enabled)(const AppState&)) {
    actions.add({.name = name,
                 .menu = "Edit",
                 .label = label,
                 .tooltip = tooltip,
                 .run = run,
                 .enabled = enabled,
                 .section = "material",
                 .submenu = "Material"});
  };
  add("material.add", "New material", "Adds a diffuse material to the scene and selects it", add_material, has_document);
  add("material.duplicate", "Duplicate material", "Adds a copy of the selected material and selects it",
      duplicate_material, has_selected_material);
  add("material.delete", "Delete material", "Removes the selected material, which no object may use", delete_material,
      has_selected_material);
  add("material.copy", "Copy parameters", "Copies all parameters and textures of the selected material", copy_material,
      has_selected_material);
  add("material.paste", "Paste parameters", "Gives the selected material the parameters that were copied",
      paste_material,
      [](const AppState& state) { return has_selected_material(state) && state.material_clipboard.scene != nullptr; });
  add("material.assign", "Assign to object",
      "Gives the selected object this material: the parts with the material that was clicked, otherwise all parts",
      assign_material, can_assign_material);
  add("material.save", "Save to library", "Writes the selected material to a file of the material library",
      [](AppState& state) { save_to_library(state); }, has_selected_material);
}

}  // namespace etendue::viewer
