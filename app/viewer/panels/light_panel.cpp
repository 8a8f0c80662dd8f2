// Light sources, the light meter, and the environment.
#include <imgui.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "light/area_light.h"
#include "light/environments/builtin_environment.h"
#include "light/light_presets.h"
#include "render/document.h"
#include "viewer/actions/action.h"
#include "viewer/panels/environment_images.h"
#include "viewer/panels/object_names.h"
#include "viewer/panels/panel.h"
#include "viewer/state/app_state.h"
#include "viewer/state/editor.h"
#include "viewer/state/object_edits.h"
#include "viewer/tools/light_meter_tool.h"
#include "viewer/widgets/action_widgets.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/color_widget.h"
#include "viewer/widgets/parameter_widgets.h"
#include "viewer/widgets/spectrum_editor.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

constexpr const char* kPresetItem = "light.preset";
const std::vector<std::string> kColor{"color.r", "color.g", "color.b"};
constexpr const char* kTemperatureItem = "light.temperature";
constexpr const char* kStrengthItem = "environment.strength";
constexpr const char* kUnitItem = "light.unit";

void list_lights(AppState& state, const scene::Scene& scene) {
  const std::vector<int>& nodes = light_nodes(state);
  for (size_t i = 0; i < scene.lights.size(); ++i) {
    const Light& light = scene.lights[i];
    const int index = static_cast<int>(i);
    const auto node =
        std::ranges::find_if(nodes, [&](int n) { return scene.nodes[static_cast<size_t>(n)].light == index; });
    if (node == nodes.end()) continue;
    const std::string text = object_name(light.name, "light", i) + "  (" + light.info().description.label + ")";
    ImGui::PushID(index);
    if (ImGui::Selectable(text.c_str(), state.selection.light == index)) {
      state.select(*node, -1);
      state.selection.light = index;
    }
    ImGui::PopID();
    state.ui.items.add("light.choose." + std::to_string(i));
  }
}

void list_emissive_materials(AppState& state, const scene::Scene& scene) {
  for (size_t i = 0; i < scene.materials.size(); ++i) {
    if (!scene.materials[i].is_emissive()) continue;
    const std::string text = object_name(scene.materials[i].name, "material", i) + "  (emissive material)";
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::Selectable(text.c_str()))
      state.panels.reveal_parameter(state, "material." + std::to_string(i) + ".emission.r");
    ImGui::PopID();
    state.ui.items.add("light.surface." + std::to_string(i));
    if (ImGui::IsItemHovered())
      tooltip(state.ui, "An emissive surface. Click to edit its emission in the Material panel");
  }
}

// The choice of a well-known light source: of those that fit the light; null: of all.
ParameterInfo preset_parameter(const Light* light) {
  ParameterInfo info;
  info.name = kPresetItem;
  info.label = "Preset";
  info.doc = "Sets colour and power of the selected light to those of a well-known light source";
  info.type = ParameterType::choice;
  info.default_value = std::string("none");
  info.options = {"none"};
  info.option_labels = {"Choose a light source"};
  for (const LightPreset& preset : kLightPresets) {
    if (light && !fits(preset, *light)) continue;
    info.options.emplace_back(preset.name);
    info.option_labels.emplace_back(preset.label);
  }
  return info;
}

void preset_widget(AppState& state, size_t index) {
  const Light& light = state.document().scene->lights[index];
  const ParameterInfo info = preset_parameter(&light);
  if (info.options.size() < 2) return;
  const auto chosen = parameter_widget(state, info);
  for (const LightPreset& preset : kLightPresets) {
    if (!chosen || *chosen != Value(std::string(preset.name))) continue;
    render::Document changed = state.document();
    auto scene = std::make_shared<scene::Scene>(*changed.scene);
    scene->lights[index] = with_preset(light, preset);
    changed.scene = std::move(scene);
    state.edit(std::move(changed), preset.label);
  }
}

enum class UnitSystem : uint8_t { photometric, radiometric };

// The quantity that the intensity of a light gives.
const LightQuantity& intensity_quantity(const Light& light) {
  const auto quantity = light.parameter("quantity");
  return quantity && *quantity == Value(std::string("power")) ? kLuminousFlux : *light.info().description.quantity;
}

// The unit of the intensity. One choice holds for all lights.
ParameterInfo unit_parameter(UnitSystem system, const LightQuantity& quantity) {
  ParameterInfo info;
  info.name = kUnitItem;
  info.label = "Unit";
  info.doc =
      "Unit in which the intensity is shown and edited. Files contain the photometric unit, as glTF does; watts follow "
      "by the luminous efficacy below";
  info.type = ParameterType::choice;
  info.default_value = std::string(system == UnitSystem::photometric ? "photometric" : "radiometric");
  info.options = {"photometric", "radiometric"};
  info.option_labels = {with_superscripts(quantity.unit) + ", " + lower_case(quantity.name),
                        with_superscripts(quantity.radiometric_unit) + ", " + lower_case(quantity.radiometric_name)};
  return info;
}

// The emitted flux of a light in both units.
void flux_values(const UiContext& ui, const Light& light, Efficacy efficacy) {
  const Rgb flux = light.flux();
  if (is_black(flux)) return;
  const auto lumens = static_cast<double>(luminance(flux));
  labelled_value(ui, kLuminousFlux.name, formatted("%.4g lm", lumens), "Emitted in all directions");
  labelled_value(ui, kLuminousFlux.radiometric_name, formatted("%.4g W", radiometric(lumens, efficacy)),
                 "The luminous flux divided by the luminous efficacy");
}

class LightPanel final : public Panel {
 public:
  PanelInfo info() const override {
    return {.name = "tab.light",
            .label = "Light",
            .description = "Light sources, light meter, environment and atmosphere",
            .place = PanelPlace::right_column};
  }

  void draw(AppState& state) override {
    const auto scene = state.document().scene;
    if (group(state.ui, "Lights", "light.")) draw_lights(state, *scene);
    if (group(state.ui, "Light meter", "meter.")) meter_.draw(state);
    if (group(state.ui, "Environment", "environment.")) draw_environment(state, scene->environment);
    if (group(state.ui, "Atmosphere", "atmosphere.", !scene->atmosphere.medium.is_clear()))
      draw_atmosphere(state, scene->atmosphere);
  }

  std::vector<ParameterInfo> parameters() const override {
    auto list = describe_all(LightMeter::Parameters{}.all());
    list.push_back(unit_parameter(UnitSystem::photometric, kLuminousIntensity));
    list.push_back(preset_parameter(nullptr));
    return list;
  }

  std::vector<ItemInfo> items() const override {
    return {
        {"light.choose.N", "Light N", "Selects light N"},
        {"light.surface.N", "Emissive material N", "Opens material N, which emits light, in the Material panel"},
        {"meter.spectrum-plot", "Spectrum", "Spectral radiance of the measured point by wavelength"},
        {"light.N.spectrum.points", "Spectrum", "Moves the points of the spectrum of light N"},
        {"light.N.spectrum.edit", "Edit as points", "Replaces the spectrum of light N by points"},
        {"environment.spectrum.points", "Spectrum", "Moves the points of the spectrum of the environment"},
        {"environment.spectrum.edit", "Edit as points", "Replaces the spectrum of the environment by points"},
        {"atmosphere.scattering-spectrum.points", "Scattering", "Moves the points of the scattering coefficient"},
        {"atmosphere.scattering-spectrum.edit", "Edit as points", "Replaces the scattering coefficient by points"},
        {"atmosphere.absorption-spectrum.points", "Absorption", "Moves the points of the absorption coefficient"},
        {"atmosphere.absorption-spectrum.edit", "Edit as points", "Replaces the absorption coefficient by points"},
        {"environment.image.N", "Environment N", "Lights the scene with built-in environment N"},
        {kTemperatureItem, "Temperature",
         "Sets the colour of the selected light to that of a black body of this temperature"},
        {kStrengthItem, "Strength", "Scales the luminance of the environment, in steps of a factor of two"}};
  }

  void add_actions(ActionList& actions) override {
    const auto use = [this](AppState& state, Vec2 position) {
      const auto& d = state.document();
      const Placement& image = state.viewport.image;
      meter_.measure((position - image.corner) / image.size * Vec2(d.width, d.height));
      state.panels.open(*this);
      return true;
    };
    actions.add({.name = kLightMeterAction,
                 .menu = "View",
                 .label = "Light meter",
                 .tooltip = "Measures radiance, irradiance, luminance, illuminance and flux where you click next",
                 .shortcut = "m",
                 .run = [use](AppState& state) { state.toggle_tool({.name = kLightMeterAction, .use = use}); },
                 .enabled = [](const AppState& state) { return state.has_document(); },
                 .checked = [](const AppState& state) { return state.is_active_tool(kLightMeterAction); }});
  }

  std::vector<WaitCondition> wait_conditions() override {
    const auto check = [this](AppState& state, std::optional<uint32_t>) -> StepStatus {
      if (!meter_.position()) return {.error = "nothing is measured; click meter.pick and then the image first"};
      return {.done = meter_.is_complete(state.editor->version())};
    };
    return {{"meter", check}};
  }

  void report(AppState& state, nlohmann::json& json) override {
    json["meter"] = meter_.report(state.editor->version());
  }

  bool reveal_parameter(AppState& state, const std::string& name) override {
    const bool is_own = name == kPresetItem || name == kTemperatureItem || name == kUnitItem;
    if (is_own || name.starts_with("environment.") || name.starts_with("atmosphere.")) return true;
    if (const auto index = object_index(name, "light")) {
      state.selection.light = *index;
      return true;
    }
    return Panel::reveal_parameter(state, name);
  }

  void update(AppState& state) override { meter_.update(state.task_context); }
  std::vector<Task*> tasks() override { return {&meter_}; }

  void draw_overlay(AppState& state, ImDrawList& draw) override {
    if (state.is_visible(*this)) meter_.draw_marker(state, draw);
  }

 private:
  void draw_lights(AppState& state, const scene::Scene& scene) {
    const bool has_emissive = std::ranges::any_of(scene.materials, [](const Material& m) { return m.is_emissive(); });
    if (scene.lights.empty() && !has_emissive)
      note(state.ui, scene.environment.black() ? "The scene has no light sources."
                                               : "The scene has no light sources. It is lit by the environment only.");
    if (scene.lights.empty() && has_emissive && scene.environment.black())
      note(state.ui,
           "Lit by emissive surfaces only. If the image is too dark, load an environment map or raise the luminance of "
           "the environment.");
    list_lights(state, scene);
    list_emissive_materials(state, scene);
    const int selected = state.selection.light;
    if (selected < 0 || static_cast<size_t>(selected) >= scene.lights.size()) return;
    const auto index = static_cast<size_t>(selected);
    const Efficacy efficacy = meter_.parameters.efficacy;
    ImGui::Separator();
    draw_object_buttons(state);
    preset_widget(state, index);
    draw_intensity(state, index, efficacy);
    const std::string section = "light." + std::to_string(index);
    section_widgets_for(state, section, kColor);
    temperature_widget(state, section + ".color", kTemperatureItem);
    section_widgets_except(state, section, {"intensity", "color.r", "color.g", "color.b"});
    emission_spectrum_editor(state, section + ".spectrum",
                             state.document().scene->lights[index].spectrum.spectrum.get());
    flux_values(state.ui, state.document().scene->lights[index], efficacy);
  }

  // Commands for the light, if it was selected as an object.
  static void draw_object_buttons(AppState& state) {
    if (!is_light_selected(state)) return;
    action_button(state, "object.duplicate");
    ImGui::SameLine();
    action_button(state, "object.delete");
    ImGui::SameLine();
    action_button(state, "light.solo");
  }

  // The intensity in the chosen unit.
  void draw_intensity(AppState& state, size_t index, Efficacy efficacy) {
    const LightQuantity& quantity = intensity_quantity(state.document().scene->lights[index]);
    const std::string name = "light." + std::to_string(index) + ".intensity";
    const bool in_watts = units_ == UnitSystem::radiometric;
    const UnitScale scale{.factor = in_watts ? radiometric(1, efficacy) : 1,
                          .unit = with_superscripts(in_watts ? quantity.radiometric_unit : quantity.unit)};
    scaled_widget(state, name, scale);
    if (const auto unit = parameter_widget(state, unit_parameter(units_, quantity)))
      units_ = *unit == Value(std::string("radiometric")) ? UnitSystem::radiometric : UnitSystem::photometric;
  }

  static void draw_atmosphere(AppState& state, const scene::Atmosphere& atmosphere) {
    section_widgets(state, "atmosphere");
    coefficient_editors(state, "atmosphere", atmosphere.medium);
  }

  void draw_environment(AppState& state, const Environment& environment) {
    environment_images_.draw(state);
    if (environment.map && !find_builtin_environment(environment.file)) note(state.ui, environment.file);
    section_widgets_for(state, "environment", {"preset"});
    strength_widget(state, "environment.tint", kStrengthItem);
    section_widgets_except(state, "environment", {"preset"});
    if (!environment.black())
      emission_spectrum_editor(state, "environment.spectrum", environment.spectrum.spectrum.get());
    action_button(state, "environment.load");
  }

  LightMeter meter_;
  EnvironmentImages environment_images_;
  UnitSystem units_ = UnitSystem::photometric;
};

}  // namespace

std::unique_ptr<Panel> make_light_panel() { return std::make_unique<LightPanel>(); }

}  // namespace etendue::viewer
