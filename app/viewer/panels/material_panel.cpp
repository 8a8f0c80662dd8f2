// The selected material: its reflection model, the parameters, and the measured checks.
#include <imgui.h>

#include <algorithm>
#include <array>
#include <utility>

#include "bsdf/bsdf_model.h"
#include "bsdf/fresnel/metal_spectra.h"
#include "render/document.h"
#include "scene/structural_edit.h"
#include "spectrum/uplift.h"
#include "viewer/panels/library_section.h"
#include "viewer/panels/object_names.h"
#include "viewer/panels/panel.h"
#include "viewer/panels/texture_section.h"
#include "viewer/state/app_state.h"
#include "viewer/state/material_edits.h"
#include "viewer/tasks/surface_analysis.h"
#include "viewer/widgets/action_widgets.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/number_widget.h"
#include "viewer/widgets/parameter_widgets.h"
#include "viewer/widgets/spectrum_editor.h"
#include "viewer/widgets/surface_checks.h"

namespace etendue::viewer {
namespace {

using Names = std::vector<std::string>;

constexpr const char* kMaterialNameItem = "material.name";
constexpr const char* kPresetsItem = "material.presets";

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
  if (begin_combo("##material", has_selection ? name(selected).c_str() : "No material selected")) {
    for (size_t i = 0; i < scene.materials.size(); ++i) {
      if (!scene::has_material(scene, static_cast<int>(i))) continue;
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

// The name of the selected material, which is applied when the field is left, and what can be done with the material.
void name_and_buttons(AppState& state, const Material& material) {
  std::array<char, 256> text{};
  material.name.copy(text.data(), text.size() - 1);
  label_column("Name");
  const bool entered =
      ImGui::InputText("##material-name", text.data(), text.size(), ImGuiInputTextFlags_EnterReturnsTrue);
  const bool left = ImGui::IsItemDeactivatedAfterEdit();
  state.ui.items.add(kMaterialNameItem);
  if (const auto requested = state.ui.items.take_request(kMaterialNameItem)) {
    rename_material(state, *requested);
    state.ui.items.answer("");
  } else if ((entered || left) && material.name != text.data()) {
    rename_material(state, text.data());
  }
  bool is_first = true;
  for (const char* name : {"material.assign", "material.add", "material.duplicate", "material.delete", "material.copy",
                           "material.paste"}) {
    const std::string& label = state.actions.find(name)->label;
    if (!std::exchange(is_first, false))
      same_line_if_fits(ImGui::CalcTextSize(label.c_str()).x + 2 * ImGui::GetStyle().FramePadding.x);
    action_button(state, name);
  }
}

// The presets of all reflection models.
void presets_combo(AppState& state) {
  label_column("Presets");
  if (begin_combo("##presets", "All models...", ImGuiComboFlags_HeightLarge)) {
    size_t index = 0;
    for (const BsdfModelInfo& model : bsdf_model_infos()) {
      if (model.presets.empty()) continue;
      ImGui::Separator();
      ImGui::TextDisabled("%s", model.description.label);
      for (const ModelPreset& preset : model.presets) {
        ImGui::PushID(static_cast<int>(index));
        if (ImGui::Selectable(preset.label.c_str())) set_model_preset(state, model.description.name, preset.name);
        ImGui::PopID();
        state.ui.items.add(std::string(kPresetsItem) + "." + std::to_string(index++));
      }
    }
    ImGui::EndCombo();
  }
  state.ui.items.add(kPresetsItem);
  if (ImGui::IsItemHovered()) tooltip(state.ui, "Selects a reflection model with the parameters of a known material");
}

Names medium_names(const AppState& state, const std::string& section) {
  Names names;
  for (const char* prefix : kMediumPrefixes) append(names, names_with_prefix(state, section, prefix));
  return names;
}

void model_widgets(AppState& state, const std::string& section, const BsdfModelRef& model) {
  section_widgets_for(state, section, {"model"});
  presets_combo(state);
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
  append(in_other_groups, names_with_prefix(state, section, "texture."));
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
    const bool has_selection = scene::has_material(*scene, selected);
    if (!has_selection) note(state.ui, "Click a surface in the image or choose a material:");
    material_combo(state, *scene, has_selection);
    if (!has_selection) {
      action_button(state, "material.add");
      return;
    }
    const Material& material = scene->materials[static_cast<size_t>(selected)];
    name_and_buttons(state, material);
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
    if (group(state.ui, "Textures", "material.texture", true)) textures_.draw(state, material);
    if (group(state.ui, "Library", "material.library", true)) library_.draw(state);
    if (group(state.ui, "Spectrum", prefix, false)) draw_spectrum(state.ui, material);
  }

  std::vector<ItemInfo> items() const override {
    return {{kMaterialNameItem, "Name", "Name of the selected material"},
            {kPresetsItem, "Presets", "Opens the list of the presets of all reflection models"},
            {"material.presets.N", "Preset N", "Selects preset N of the open list"},
            {"material.texture.SLOT", "Texture", "Image of a texture"},
            {"material.texture.SLOT.replace", "Replace...", "Reads another image file for a texture"},
            {"material.texture.SLOT.remove", "Remove", "Removes a texture from the material"},
            {"material.texture.add", "Add texture...", "Opens the list of textures that the material does not have"},
            {"material.texture.add.SLOT", "Texture", "Reads an image file for a texture of the open list"},
            {"material.library.N", "Material file N", "Gives the selected material the parameters of the file"},
            {"material.library.N.add", "Add as new material", "Adds a material from the file of the open menu"},
            {"material.spectrum-plot", "Spectrum", "Reflectance by wavelength of a metal or of the base colour"},
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
    if (name == kMaterialNameItem || name == "textures.channel") return true;
    const auto index = object_index(name, "material");
    if (index) state.selection.material = *index;
    return index.has_value();
  }

  std::vector<ParameterInfo> parameters() const override { return describe_all(TextureSection::Parameters{}.all()); }

  void update(AppState& state) override {
    if (state.is_visible(*this)) state.tasks.surface_analysis->request_checks();
  }

 private:
  TextureSection textures_;
  LibrarySection library_;
};

}  // namespace

std::unique_ptr<Panel> make_material_panel() { return std::make_unique<MaterialPanel>(); }

}  // namespace etendue::viewer
