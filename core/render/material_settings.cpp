#include "render/material_settings.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "base/json_text.h"
#include "material/texture_slots.h"
#include "render/document_parameters.h"
#include "render/setting_order.h"

namespace etendue::render {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr const char* kSection = "material.0";
constexpr std::string_view kTexturePrefix = "texture.";

// A document with one material, whose parameters are edited without copying a large scene.
Document document_of(const Material& material, const std::vector<Texture>& textures) {
  auto scene = std::make_shared<scene::Scene>();
  scene->materials.push_back(material);
  scene->textures = textures;
  Document document;
  document.scene = std::move(scene);
  return document;
}

std::vector<Setting> settings_of(const Document& document) {
  std::vector<Setting> list;
  const size_t prefix = std::string_view(kSection).size() + 1;
  for (const DocumentParameter& parameter : section_parameters(document, kSection))
    list.push_back({parameter.info.name.substr(prefix), parameter.info.default_value});
  return list;
}

// Assigns the settings that differ. Equal ones are left out, because a file may hold values beyond the range.
Result<void> assign_different(Document& document, const std::map<std::string, Value>& settings) {
  for (const SettingKind kind : kSettingKinds)
    for (const auto& [name, value] : settings) {
      if (kind_of_setting(name) != kind) continue;
      const std::string qualified = std::string(kSection) + "." + name;
      const auto current = get(document, qualified);
      if (current && *current == value) continue;
      auto changed = with(document, qualified, value);
      if (!changed) return changed.error();
      document = std::move(*changed);
    }
  return {};
}

Error damaged(const std::string& file) {
  return input_error(file + ": is damaged; give a material file that etendue wrote");
}

Result<Value> value_from(const json& j, const std::string& file) {
  if (j.is_boolean()) return Value(j.get<bool>());
  if (j.is_number_integer()) return Value(j.get<int64_t>());
  if (j.is_number()) return Value(j.get<double>());
  if (j.is_string()) return Value(j.get<std::string>());
  return damaged(file);
}

Result<MaterialFile> material_from(const json& j, const std::string& file) {
  MaterialFile result{.name = j.at("name").get<std::string>()};
  for (const auto& [name, setting] : j.at("settings").items()) {
    const auto value = value_from(setting, file);
    if (!value) return value.error();
    result.settings.push_back({name, *value});
  }
  const fs::path folder = fs::path(file).parent_path();
  for (const auto& [slot, image] : j.at("textures").items())
    result.textures.push_back({slot, (folder / image.get<std::string>()).string()});
  return result;
}

// Writes the image of a texture; returns the name of the file, or an empty one if the texture has no image in memory.
Result<std::string> write_texture(const fs::path& material_file, const TextureSlot& slot, const Texture& texture) {
  if (!texture.image) return std::string();
  const auto png = image::encode_png(*texture.image);
  if (!png) return png.error();
  const std::string name = material_file.stem().string() + "-" + slot.name + ".png";
  const auto ok = write_file(material_file.parent_path() / name, png->data(), png->size());
  return ok ? Result<std::string>(name) : ok.error();
}

}  // namespace

std::vector<Setting> material_settings(const Material& material, const std::vector<Texture>& textures) {
  return settings_of(document_of(material, textures));
}

Result<Material> with_material_settings(const Material& material, const std::vector<Texture>& textures,
                                        const std::vector<Setting>& settings) {
  std::map<std::string, Value> complete;
  for (Setting& setting : settings_of(document_of(Material{}, textures)))
    complete[setting.name] = std::move(setting.value);
  for (const Setting& setting : settings) complete[setting.name] = setting.value;
  Document document = document_of(material, textures);
  if (const auto ok = assign_different(document, complete); !ok) return ok.error();
  return document.scene->materials.front();
}

Result<Document> with_material_settings(const Document& document, size_t material,
                                        const std::vector<Setting>& settings) {
  const scene::Scene& scene = *document.scene;
  auto changed_material = with_material_settings(scene.materials[material], scene.textures, settings);
  if (!changed_material) return changed_material.error();
  Document changed = document;
  edit_scene(changed, [&](scene::Scene& s) { s.materials[material] = std::move(*changed_material); });
  return changed;
}

Result<void> write_material_file(const std::string& file, const scene::Scene& scene, size_t material) {
  const Material& m = scene.materials[material];
  std::map<std::string, Value> defaults;
  for (Setting& setting : settings_of(document_of(Material{}, {}))) defaults[setting.name] = std::move(setting.value);
  json textures = json::object(), settings = json::object();
  for (const Setting& setting : material_settings(m, scene.textures)) {
    const auto original = defaults.find(setting.name);
    const bool is_texture = setting.name.starts_with(kTexturePrefix) && kind_of_setting(setting.name) == SettingKind::selection;
    if (!is_texture && (original == defaults.end() || original->second != setting.value))
      settings[setting.name] = to_json_value<json>(setting.value);
  }
  for (const TextureSlot& slot : texture_slots()) {
    const int texture = (m.*slot.use).texture;
    if (texture < 0) continue;
    const auto name = write_texture(file, slot, scene.textures[static_cast<size_t>(texture)]);
    if (!name) return name.error();
    if (!name->empty()) textures[slot.name] = *name;
  }
  const json j{{"program", "etendue"}, {"name", m.name}, {"settings", settings}, {"textures", textures}};
  const std::string text = json_text(j, 2) + "\n";
  return write_file(file, text.data(), text.size());
}

Result<MaterialFile> read_material_file(const std::string& file) {
  const auto bytes = read_file(file);
  if (!bytes) return bytes.error();
  const auto* text = reinterpret_cast<const char*>(bytes->data());
  const json j = json::parse(text, text + bytes->size(), nullptr, false);
  if (!j.is_object() || j.value("program", json()) != "etendue") return damaged(file);
  try {
    return material_from(j, file);
  } catch (const json::exception&) {
    return damaged(file);
  }
}

Result<MaterialFile> read_material_with_textures(const std::string& file) {
  auto read = read_material_file(file);
  if (!read) return read;
  for (MaterialFile::TextureFile& texture : read->textures) {
    scene::StructuralEdit edit{.kind = scene::EditKind::add_texture, .file = texture.file};
    if (const auto ok = scene::read_image(edit); !ok) return ok.error();
    texture.image = std::move(edit.image);
  }
  return read;
}

Result<Document> with_material(const Document& document, size_t material, const MaterialFile& content,
                               const std::string& file) {
  Document changed = document;
  std::vector<Setting> settings = content.settings;
  for (const MaterialFile::TextureFile& texture : content.textures) {
    const auto index = static_cast<int64_t>(changed.scene->textures.size());
    auto with_texture = with_structural_edit(
        changed, {.kind = scene::EditKind::add_texture, .file = texture.file, .image = texture.image});
    if (!with_texture) return with_texture.error();
    changed = std::move(*with_texture);
    settings.push_back({std::string(kTexturePrefix) + texture.slot, index});
  }
  auto result = with_material_settings(changed, material, settings);
  return result ? std::move(result) : input_error(file + ": " + result.error().message);
}

Result<Document> with_material_file(const Document& document, size_t material, const std::string& file) {
  const auto content = read_material_file(file);
  return content ? with_material(document, material, *content, file) : content.error();
}

}  // namespace etendue::render
