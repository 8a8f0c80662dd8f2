// The selected material: its reflection model, the parameters, and the measured checks.
#include <imgui.h>

#include <algorithm>

#include "bsdf/bsdf_model.h"
#include "bsdf/fresnel/metal_spectra.h"
#include "render/document.h"
#include "spectrum/uplift.h"
#include "viewer/panels/object_names.h"
#include "viewer/panels/panel.h"
#include "viewer/state/app_state.h"
#include "viewer/tasks/surface_analysis.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/parameter_widgets.h"
#include "viewer/widgets/spectrum_editor.h"
#include "viewer/widgets/surface_checks.h"

namespace etendue::viewer {
namespace {

using Names = std::vector<std::string>;

// Parameters of materials, without "material.N.", by the group that shows them.
const Names kCommonNames{"base-color.r", "base-color.g", "base-color.b",     "emission.r",
                         "emission.g",   "emission.b",   "emission-spectrum"};
const Names kAttenuationNames{"attenuation-color.r", "attenuation-color.g", "attenuation-color.b",
                              "attenuation-distance"};
const Names kTransmissionNames{"transmission",        "thickness",           "attenuation-color.r",
                               "attenuation-color.g", "attenuation-color.b", "attenuation-distance"};
const Names kOpacityNames{"alpha", "alpha-mode", "alpha-cutoff", "normal-scale", "double-sided", "unlit"};

// Prefixes of the parameters of the medium inside a solid.
constexpr const char* kMediumPrefixes[] = {"medium",      "scattering.", "scattering-", "absorption.",
                                           "absorption-", "phase",       "density",     "boundary-only"};

// A layer of the glTF surface. Its group is open if the material has the layer.
struct Layer {
  const char* label;
  const char* prefix;  // of the names of its parameters
  bool (*is_present)(const Material&);
};
constexpr Layer kLayers[] = {
    {"Clear coat", "clearcoat", [](const Material& m) { return m.clearcoat > 0; }},
    {"Sheen", "sheen-", [](const Material& m) { return !is_black(m.sheen_color); }},
    {"Iridescence", "iridescence", [](const Material& m) { return m.iridescence > 0; }},
    {"Diffuse transmission", "diffuse-transmission", [](const Material& m) { return m.diffuse_transmission > 0; }},
};

bool has_textures(const Material& m) {
  const TextureUse* uses[] = {&m.base_color_texture,
                              &m.metallic_roughness_texture,
                              &m.normal_texture,
                              &m.emission_texture,
                              &m.specular_texture,
                              &m.specular_color_texture,
                              &m.transmission_texture,
                              &m.anisotropy_texture,
                              &m.clearcoat_texture,
                              &m.clearcoat_roughness_texture,
                              &m.clearcoat_normal_texture,
                              &m.sheen_color_texture,
                              &m.sheen_roughness_texture,
                              &m.iridescence_texture,
                              &m.iridescence_thickness_texture,
                              &m.diffuse_transmission_texture,
                              &m.diffuse_transmission_color_texture};
  return std::ranges::any_of(uses, [](const TextureUse* use) { return use->texture >= 0; });
}

// The names of all parameters of a section that begin with a prefix, without the section.
Names names_with_prefix(const AppState& state, const std::string& section, const std::string& prefix) {
  Names names;
  for (const auto& parameter : render::section_parameters(state.document(), section))
    if (parameter.info.name.starts_with(section + "." + prefix))
      names.push_back(parameter.info.name.substr(section.size() + 1));
  return names;
}

void append(Names& names, const Names& more) { names.insert(names.end(), more.begin(), more.end()); }

void material_combo(AppState& state, const scene::Scene& scene, bool has_selection) {
  const auto name = [&](size_t i) { return object_name(scene.materials[i].name, "material", i); };
  const auto selected = static_cast<size_t>(std::max(0, state.selection.material));
  ImGui::SetNextItemWidth(-1);
  if (ImGui::BeginCombo("##material", has_selection ? name(selected).c_str() : "No material selected")) {
    for (size_t i = 0; i < scene.materials.size(); ++i) {
      ImGui::PushID(static_cast<int>(i));
      if (ImGui::Selectable(name(i).c_str(), has_selection && i == selected))
        state.selection.material = static_cast<int>(i);
      ImGui::PopID();
      state.ui.items.add("material.choose." + std::to_string(i));
    }
    ImGui::EndCombo();
  }
  state.ui.items.add("material.choose");
  if (ImGui::IsItemHovered())
    tooltip(state.ui, "The material to edit. A click in the image selects the material under the pointer");
}

Names medium_names(const AppState& state, const std::string& section) {
  Names names;
  for (const char* prefix : kMediumPrefixes) append(names, names_with_prefix(state, section, prefix));
  return names;
}

void model_widgets(AppState& state, const std::string& section, const BsdfModelRef& model) {
  section_widgets_for(state, section, {"model"});
  draw_surface_checks(state.ui, state.tasks.surface_analysis->result(0));
  if (!model) return;
  const BsdfModelDescription& description = model->info().description;
  note(state.ui, description.summary);
  const std::string prefix = std::string(description.name) + ".";
  Names names{prefix + "preset"};
  for (const auto& info : model->parameters()) names.push_back(prefix + info.name);
  section_widgets_for(state, section, names);
}

// The points of the spectrum of an emissive material.
void emission_editor(AppState& state, const std::string& section, const Material& material) {
  if (material.is_emissive())
    emission_spectrum_editor(state, section + ".emission-spectrum", material.emission_spectrum.spectrum.get());
}

void gltf_widgets(AppState& state, const std::string& section, const Material& material) {
  const std::string prefix = section + ".";
  Names in_other_groups{"model"};
  append(in_other_groups, kTransmissionNames);
  append(in_other_groups, kOpacityNames);
  append(in_other_groups, medium_names(state, section));
  for (const Layer& layer : kLayers) append(in_other_groups, names_with_prefix(state, section, layer.prefix));
  if (group(state.ui, "Base layer", prefix)) {
    section_widgets_except(state, section, in_other_groups);
    emission_editor(state, section, material);
  }
  if (group(state.ui, "Transmission", prefix)) section_widgets_for(state, section, kTransmissionNames);
  for (const Layer& layer : kLayers)
    if (group(state.ui, layer.label, prefix + layer.prefix, layer.is_present(material)))
      section_widgets_for(state, section, names_with_prefix(state, section, layer.prefix));
}

// The reflectance of a metal at normal incidence, or the smooth spectrum of the base colour.
void draw_spectrum(UiContext& ui, const Material& material) {
  const auto metals = metal_spectra();
  const std::string_view preset = material.model ? preset_of(*material.model.model) : std::string_view();
  const auto metal = std::ranges::find(metals, preset, &MetalSpectrum::name);
  if (metal != metals.end())
    return spectrum_plot(ui, "material.spectrum-plot", "Reflectance at normal incidence", 1, [&](double wavelength) {
      const auto w = static_cast<float>(wavelength);
      const double eta = metal->eta(w), kappa = metal->kappa(w);
      return ((eta - 1) * (eta - 1) + kappa * kappa) / ((eta + 1) * (eta + 1) + kappa * kappa);
    });
  spectrum_plot(ui, "material.spectrum-plot", "Spectrum of the base colour", 1, [&](double wavelength) {
    return static_cast<double>(uplift_reflectance(material.base_color, only_wavelength(wavelength))[0]);
  });
}

class MaterialPanel final : public Panel {
 public:
  PanelInfo info() const override {
    return {.name = "tab.material",
            .label = "Material",
            .description = "Reflection model and parameters of the selected material",
            .place = PanelPlace::right_column};
  }

  void draw(AppState& state) override {
    const auto scene = state.document().scene;
    const int selected = state.selection.material;
    const bool has_selection = selected >= 0 && static_cast<size_t>(selected) < scene->materials.size();
    if (!has_selection) note(state.ui, "Click a surface in the image or choose a material:");
    material_combo(state, *scene, has_selection);
    if (!has_selection) return;
    const Material& material = scene->materials[static_cast<size_t>(selected)];
    if (has_textures(material)) note(state.ui, "Textured: the values below multiply the textures.");
    const std::string section = "material." + std::to_string(selected);
    const std::string prefix = section + ".";
    if (group(state.ui, "Model", prefix)) model_widgets(state, section, material.model);
    if (material.model) {
      section_widgets_for(state, section, kCommonNames);
      emission_editor(state, section, material);
      if (material.model->is_solid() && group(state.ui, "Attenuation", prefix))
        section_widgets_for(state, section, kAttenuationNames);
    } else {
      gltf_widgets(state, section, material);
    }
    if (group(state.ui, "Medium", prefix, !material.medium.is_clear() || material.boundary_only)) {
      section_widgets_for(state, section, medium_names(state, section));
      coefficient_editors(state, section, material.medium);
    }
    if (group(state.ui, "Opacity and sidedness", prefix)) section_widgets_for(state, section, kOpacityNames);
    if (group(state.ui, "Spectrum", prefix, false)) draw_spectrum(state.ui, material);
  }

  std::vector<ItemInfo> items() const override {
    return {{"material.spectrum-plot", "Spectrum", "Reflectance by wavelength of a metal or of the base colour"},
            {"material.N.emission-spectrum.points", "Emission", "Moves the points of the emission spectrum"},
            {"material.N.emission-spectrum.edit", "Edit as points", "Replaces the emission spectrum by points"},
            {"material.N.scattering-spectrum.points", "Scattering", "Moves the points of the scattering coefficient"},
            {"material.N.scattering-spectrum.edit", "Edit as points", "Replaces the scattering coefficient by points"},
            {"material.N.absorption-spectrum.points", "Absorption", "Moves the points of the absorption coefficient"},
            {"material.N.absorption-spectrum.edit", "Edit as points", "Replaces the absorption coefficient by points"},
            {"material.choose", "Material", "Opens the list of materials"},
            {"material.choose.N", "Material N", "Selects material N of the open list"}};
  }

  bool reveal_parameter(AppState& state, const std::string& name) override {
    const auto index = object_index(name, "material");
    if (index) state.selection.material = *index;
    return index.has_value();
  }

  void update(AppState& state) override {
    if (state.is_visible(*this)) state.tasks.surface_analysis->request_checks();
  }
};

}  // namespace

std::unique_ptr<Panel> make_material_panel() { return std::make_unique<MaterialPanel>(); }

}  // namespace etendue::viewer
