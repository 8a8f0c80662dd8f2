// Edits of the materials of the scene, their textures, and the library of material files. Each is one step of undo.
//
// The material is the selected one; nothing happens if there is none. Errors become messages, and nothing changes then.
#pragma once
#include <filesystem>
#include <memory>
#include <string>

#include "scene/forward.h"

namespace etendue {
struct TextureSlot;
}

namespace etendue::viewer {

struct AppState;

// A material that was copied, as it was at that time. The scene is kept because its textures may be pasted.
struct MaterialClipboard {
  std::shared_ptr<const scene::Scene> scene;  // null: nothing was copied
  size_t material = 0;
};

bool has_selected_material(const AppState& state);

void add_material(AppState& state);
void duplicate_material(AppState& state);
void delete_material(AppState& state);
void rename_material(AppState& state, const std::string& name);

void copy_material(AppState& state);
// Replaces all parameters except for the name. Textures that the scene does not have are left out.
void paste_material(AppState& state);

// Gives the selected object the material: to the parts that have the material of the part that was clicked, otherwise
// to all parts.
void assign_material(AppState& state);
bool can_assign_material(const AppState& state);

// Selects a reflection model with the values of a preset.
void set_model_preset(AppState& state, const std::string& model, const std::string& preset);

// The texture of a slot from an image file, which is read in the background (FileEdits), or none.
void load_texture(AppState& state, const TextureSlot& slot, const std::string& file);
void remove_texture(AppState& state, const TextureSlot& slot);

// Where material files are: the folder of the settings, or $XDG_DATA_HOME/etendue/materials. Empty if there is none.
std::filesystem::path material_folder(const AppState& state);
// Saves the material in the folder, under a name that no file has, in the background. Only one can be saved at a time.
void save_to_library(AppState& state);
// Replaces the parameters of the material by those of a file, which is read in the background (FileEdits), as the next.
void apply_material_file(AppState& state, const std::string& file);
// Adds a material of the scene from a file, and selects it.
void add_material_from_file(AppState& state, const std::string& file);

}  // namespace etendue::viewer
