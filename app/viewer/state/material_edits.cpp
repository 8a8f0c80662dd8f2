#include "viewer/state/material_edits.h"

#include <algorithm>

#include "base/user_folders.h"
#include "material/texture_slots.h"
#include "render/material_settings.h"
#include "scene/structural_edit.h"
#include "viewer/files/file_edits.h"
#include "viewer/files/file_names.h"
#include "viewer/panels/object_names.h"
#include "viewer/state/app_state.h"
#include "viewer/state/document_info.h"

namespace etendue::viewer {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMaterial = "material";

size_t selected_material(const AppState& state) { return static_cast<size_t>(state.selection.material); }

std::string material_name(const AppState& state, size_t index) {
  return object_name(state.document().scene->materials[index].name, kMaterial, index);
}

// "glass", "glass 2", ...: the first name that no material has.
std::string free_material_name(const scene::Scene& scene, const std::string& base) {
  for (size_t i = 1;; ++i) {
    const std::string name = i == 1 ? base : base + " " + std::to_string(i);
    if (std::ranges::find(scene.materials, name, &Material::name) == scene.materials.end()) return name;
  }
}

// Makes the result a step of undo; an error becomes a message. Returns whether there was none.
bool apply_result(AppState& state, Result<render::Document> changed, const std::string& step) {
  if (!changed) {
    state.notices.add_error(changed.error().message);
    return false;
  }
  state.edit(std::move(*changed), step);
  return true;
}

bool apply_edit_of_materials(AppState& state, const scene::StructuralEdit& edit, const std::string& step) {
  return apply_result(state, render::with_structural_edit(state.document(), edit), step);
}

void select_last_material(AppState& state) {
  state.selection.material = static_cast<int>(state.document().scene->materials.size()) - 1;
}

std::string texture_parameter(int material, const TextureSlot& slot) {
  return "material." + std::to_string(material) + ".texture." + slot.name;
}

// The texture of the document that is equal; -1 if there is none.
int64_t index_of_texture(const scene::Scene& scene, const Texture& texture) {
  const auto found = std::ranges::find(scene.textures, texture);
  return found == scene.textures.end() ? -1 : found - scene.textures.begin();
}

const scene::Node* node_with_surface(const AppState& state) {
  if (!state.has_document() || state.selection.node < 0) return nullptr;
  const scene::Node& node = state.document().scene->nodes[static_cast<size_t>(state.selection.node)];
  return node.mesh >= 0 ? &node : nullptr;
}

// Whether the selected object shows the texture coordinates of an image; without an object there is nothing to say.
bool has_texture_coordinates(const AppState& state) {
  const scene::Node* node = node_with_surface(state);
  if (!node) return true;
  const auto& primitives = state.document().scene->meshes[static_cast<size_t>(node->mesh)].primitives;
  return std::ranges::none_of(primitives, [](const scene::Primitive& p) { return p.mesh && p.mesh->uvs[0].empty(); });
}

// Gives a material the texture that `edit` adds. The material may have been removed since the image was asked for.
void set_texture(AppState& state, const TextureSlot& slot, const scene::StructuralEdit& edit, int material) {
  if (!scene::has_material(*state.document().scene, material)) return;
  const auto index = static_cast<int64_t>(state.document().scene->textures.size());
  auto changed = render::with_structural_edit(state.document(), edit);
  if (changed) changed = render::with(*changed, texture_parameter(material, slot), Value(index));
  if (!apply_result(state, std::move(changed), std::string("Texture ") + slot.label)) return;
  if (!has_texture_coordinates(state))
    state.notices.add_message("The selected object has no texture coordinates, so it shows one texel of the texture.");
}

void add_material_of(AppState& state, const std::string& file, const render::MaterialFile& content) {
  const scene::Scene& scene = *state.document().scene;
  const std::string name = free_material_name(scene, fs::path(file).stem().string());
  auto changed = render::with_structural_edit(state.document(), {.kind = scene::EditKind::add_material, .name = name});
  if (changed) changed = render::with_material(*changed, scene.materials.size(), content, file);
  if (apply_result(state, std::move(changed), "Add " + name)) select_last_material(state);
}

// A name without characters that separate folders.
std::string file_stem_of(std::string name) {
  for (char& c : name)
    if (c == '/' || c == '\\' || static_cast<unsigned char>(c) < 32) c = '-';
  return name.starts_with('.') ? "-" + name : name;
}

}  // namespace

bool has_selected_material(const AppState& state) {
  return state.has_document() && scene::has_material(*state.document().scene, state.selection.material);
}

void add_material(AppState& state) {
  if (!state.has_document()) return;
  const std::string name = free_material_name(*state.document().scene, kMaterial);
  if (apply_edit_of_materials(state, {.kind = scene::EditKind::add_material, .name = name}, "Add " + name))
    select_last_material(state);
}

void duplicate_material(AppState& state) {
  if (!has_selected_material(state)) return;
  const std::string old = material_name(state, selected_material(state));
  const std::string name = free_material_name(*state.document().scene, old);
  if (apply_edit_of_materials(
          state, {.kind = scene::EditKind::add_material, .name = name, .material = state.selection.material},
          "Duplicate " + old))
    select_last_material(state);
}

void delete_material(AppState& state) {
  if (!has_selected_material(state)) return;
  const std::string name = material_name(state, selected_material(state));
  if (apply_edit_of_materials(
          state, {.kind = scene::EditKind::remove_material, .material = state.selection.material}, "Delete " + name))
    state.selection.material = -1;
}

void rename_material(AppState& state, const std::string& name) {
  if (!has_selected_material(state)) return;
  const std::string old = material_name(state, selected_material(state));
  apply_edit_of_materials(
      state, {.kind = scene::EditKind::rename_material, .name = name, .material = state.selection.material},
      "Rename " + old);
}

void copy_material(AppState& state) {
  if (!has_selected_material(state)) return;
  state.material_clipboard = {state.document().scene, selected_material(state)};
  state.notices.add_message("Copied " + material_name(state, selected_material(state)));
}

void paste_material(AppState& state) {
  const MaterialClipboard& copied = state.material_clipboard;
  if (!has_selected_material(state) || !copied.scene) return;
  Material material = copied.scene->materials[copied.material];
  const scene::Scene& scene = *state.document().scene;
  for (const TextureSlot& slot : texture_slots()) {
    TextureUse& use = material.*slot.use;
    if (use.texture < 0) continue;
    use.texture =
        static_cast<int>(index_of_texture(scene, copied.scene->textures[static_cast<size_t>(use.texture)]));
    if (use.texture < 0) state.notices.add_message(std::string("The scene does not have the texture ") + slot.label);
  }
  apply_result(state,
               render::with_material_settings(state.document(), selected_material(state),
                                              render::material_settings(material, scene.textures)),
               "Paste parameters of " + object_name(material.name, kMaterial, copied.material));
}

bool can_assign_material(const AppState& state) { return has_selected_material(state) && node_with_surface(state); }

void assign_material(AppState& state) {
  if (!can_assign_material(state)) return;
  const scene::Node& node = *node_with_surface(state);
  const auto& primitives = state.document().scene->meshes[static_cast<size_t>(node.mesh)].primitives;
  const auto is_clicked = [&](const scene::Primitive& p) { return p.material == state.selection.part; };
  const bool assigns_all = std::ranges::none_of(primitives, is_clicked);
  const std::string step = "Assign " + material_name(state, selected_material(state));
  Result<render::Document> changed = state.document();
  for (size_t i = 0; changed && i < primitives.size(); ++i)
    if (assigns_all || is_clicked(primitives[i]))
      changed = render::with_structural_edit(*changed, {.kind = scene::EditKind::assign_material,
                                                        .node = state.selection.node,
                                                        .material = state.selection.material,
                                                        .primitive = static_cast<int>(i)});
  if (apply_result(state, std::move(changed), step)) state.selection.part = state.selection.material;
}

void set_model_preset(AppState& state, const std::string& model, const std::string& preset) {
  if (!has_selected_material(state)) return;
  const std::string section = "material." + std::to_string(state.selection.material) + ".";
  auto changed = render::with(state.document(), section + "model", Value(model));
  if (changed) changed = render::with(*changed, section + model + ".preset", Value(preset));
  apply_result(state, std::move(changed), "Preset of " + material_name(state, selected_material(state)));
}

void load_texture(AppState& state, const TextureSlot& slot, const std::string& file) {
  if (!has_selected_material(state)) return;
  state.files.edits->start([&slot, file, material = state.selection.material]() -> Result<FileEdits::Edit> {
    scene::StructuralEdit edit{.kind = scene::EditKind::add_texture, .file = file};
    if (const auto ok = scene::read_image(edit); !ok) return ok.error();
    return FileEdits::Edit([&slot, edit, material](AppState& s) { set_texture(s, slot, edit, material); });
  });
}

void remove_texture(AppState& state, const TextureSlot& slot) {
  if (!has_selected_material(state)) return;
  apply_result(state,
               render::with(state.document(), texture_parameter(state.selection.material, slot), Value(int64_t{-1})),
               std::string("Remove texture ") + slot.label);
}

fs::path material_folder(const AppState& state) {
  if (!state.settings.material_folder.empty()) return state.settings.material_folder;
  return default_material_folder();
}

void save_to_library(AppState& state) {
  const fs::path folder = material_folder(state);
  if (!has_selected_material(state) || folder.empty() || state.files.material_save.running()) return;
  const std::string stem = file_stem_of(material_name(state, selected_material(state)));
  const auto save = [folder, stem, scene = state.document().scene,
                     material = selected_material(state)]() -> Result<std::string> {
    std::error_code code;
    fs::create_directories(folder, code);
    const std::string file = unused_file(folder, stem, render::kMaterialExtension).string();
    const auto written = render::write_material_file(file, *scene, material);
    return written ? Result<std::string>(file) : written.error();
  };
  state.files.material_save.start(save, state.task_context.wake);
}

void apply_material_file(AppState& state, const std::string& file) {
  if (!has_selected_material(state)) return;
  state.files.edits->start([file, material = state.selection.material]() -> Result<FileEdits::Edit> {
    auto content = render::read_material_with_textures(file);
    if (!content) return content.error();
    return FileEdits::Edit([file, material, content = std::move(*content)](AppState& s) {
      if (!scene::has_material(*s.document().scene, material)) return;
      apply_result(s, render::with_material(s.document(), static_cast<size_t>(material), content, file),
                   "Load " + fs::path(file).stem().string());
    });
  });
}

void add_material_from_file(AppState& state, const std::string& file) {
  if (!state.has_document()) return;
  state.files.edits->start([file]() -> Result<FileEdits::Edit> {
    auto content = render::read_material_with_textures(file);
    if (!content) return content.error();
    return FileEdits::Edit([file, content = std::move(*content)](AppState& s) { add_material_of(s, file, content); });
  });
}

}  // namespace etendue::viewer
