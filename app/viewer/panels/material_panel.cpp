// What is this surface made of, and what if it were something else?
#include <imgui.h>

#include "viewer/layout/interface.h"
#include "viewer/widgets/parameter_widgets.h"

namespace etendue::viewer {
namespace {

std::string name_of(const scene::Scene& scene, size_t index) {
  const std::string& name = scene.materials[index].name;
  return name.empty() ? "material " + std::to_string(index) : name;
}

bool has_textures(const Material& m) {
  for (const TextureUse* use :
       {&m.base_color_texture, &m.metallic_roughness_texture, &m.normal_texture, &m.emission_texture,
        &m.specular_texture, &m.specular_color_texture, &m.transmission_texture, &m.anisotropy_texture,
        &m.clearcoat_texture, &m.clearcoat_roughness_texture, &m.clearcoat_normal_texture, &m.sheen_color_texture,
        &m.sheen_roughness_texture, &m.iridescence_texture, &m.iridescence_thickness_texture,
        &m.diffuse_transmission_texture, &m.diffuse_transmission_color_texture})
    if (use->texture >= 0) return true;
  return false;
}

// Which model, what it is, what was measured of it, and its numbers.
void model_widgets(Workbench& w, const std::string& section, const BsdfModelRef& model) {
  std::vector<std::string> names{"model"};
  some_widgets(w, section, names);
  if (const auto* reading = w.surface.shown(0)) draw_badges(w, *reading);
  if (!model) return;
  const BsdfModelDescription& d = model->info().description;
  note(w, d.doc);
  const std::string own = std::string(d.name) + ".";
  names = {own + "preset"};
  for (const auto& info : model->parameters()) names.push_back(own + info.name);
  some_widgets(w, section, names);
}

// The settings of a section whose names, without it, begin so.
std::vector<std::string> names_that_begin(const Workbench& w, const std::string& section, const std::string& start) {
  std::vector<std::string> names;
  for (const auto& binding : render::bindings(w.editor.document(), section))
    if (binding.info.name.starts_with(section + "." + start))
      names.push_back(binding.info.name.substr(section.size() + 1));
  return names;
}

// What glTF's extensions lay over the surface; a group is open where there is something of it.
struct Layer {
  const char *label, *start;
  bool (*there)(const Material&);
};
constexpr Layer kLayers[] = {
    {"Clear coat", "clearcoat", [](const Material& m) { return m.clearcoat > 0; }},
    {"Sheen", "sheen-", [](const Material& m) { return !is_black(m.sheen_color); }},
    {"Thin film", "iridescence", [](const Material& m) { return m.iridescence > 0; }},
    {"Diffuse transmission", "diffuse-transmission", [](const Material& m) { return m.diffuse_transmission > 0; }},
};

void gltf_widgets(Workbench& w, const std::string& section, const Material& material,
                  const std::vector<std::string>& glass, std::vector<std::string> elsewhere) {
  elsewhere.insert(elsewhere.end(), glass.begin(), glass.end());
  elsewhere.emplace_back("model");
  std::vector<std::vector<std::string>> layers;
  for (const Layer& layer : kLayers) {
    layers.push_back(names_that_begin(w, section, layer.start));
    elsewhere.insert(elsewhere.end(), layers.back().begin(), layers.back().end());
  }
  if (group(w, "Surface", section + ".")) other_widgets(w, section, elsewhere);
  if (group(w, "Light through it", section + ".")) some_widgets(w, section, glass);
  for (size_t i = 0; i < layers.size(); ++i)
    if (group(w, kLayers[i].label, section + "." + kLayers[i].start, kLayers[i].there(material)))
      some_widgets(w, section, layers[i]);
}

}  // namespace

void draw_material_panel(Workbench& w) {
  const auto scene = w.editor.document().scene;
  const size_t count = scene->materials.size();
  if (w.selection.material < 0 || static_cast<size_t>(w.selection.material) >= count) {
    note(w, "Click something in the picture, or choose a material:");
  }
  const bool chosen = w.selection.material >= 0 && static_cast<size_t>(w.selection.material) < count;
  const auto index = static_cast<size_t>(std::max(0, w.selection.material));
  ImGui::SetNextItemWidth(-1);
  if (ImGui::BeginCombo("##material", chosen ? name_of(*scene, index).c_str() : "none chosen")) {
    for (size_t i = 0; i < count; ++i) {
      ImGui::PushID(static_cast<int>(i));
      if (ImGui::Selectable(name_of(*scene, i).c_str(), chosen && i == index))
        w.selection.material = static_cast<int>(i);
      ImGui::PopID();
      w.items.place("material.choose." + std::to_string(i));
    }
    ImGui::EndCombo();
  }
  w.items.place("material.choose");
  if (ImGui::IsItemHovered())
    tooltip(w, "The material that is edited; a click in the picture chooses the one under the pointer");
  if (!chosen) return;
  if (has_textures(scene->materials[index])) note(w, "It has textures: the numbers below multiply them.");
  const std::string section = "material." + std::to_string(index), prefix = section + ".";
  const std::vector<std::string> inside{"attenuation-color.r", "attenuation-color.g", "attenuation-color.b",
                                        "attenuation-distance"};
  std::vector<std::string> glass{"transmission", "thickness"};
  glass.insert(glass.end(), inside.begin(), inside.end());
  const std::vector<std::string> shared{"base-color.r", "base-color.g", "base-color.b",
                                        "emission.r",   "emission.g",   "emission.b"};
  const std::vector<std::string> cover{"alpha", "alpha-mode", "alpha-cutoff", "normal-scale", "double-sided", "unlit"};
  const BsdfModelRef model = scene->materials[index].model;
  if (group(w, "Model", prefix)) model_widgets(w, section, model);
  if (model) {
    some_widgets(w, section, shared);
    if (model->solid() && group(w, "Inside", prefix)) some_widgets(w, section, inside);
  } else {
    gltf_widgets(w, section, scene->materials[index], glass, cover);
  }
  if (group(w, "Cover and sides", prefix)) some_widgets(w, section, cover);
}

}  // namespace etendue::viewer
