// Where does the light come from, and how much of it?
#include <imgui.h>

#include "light/light_presets.h"
#include "viewer/layout/interface.h"
#include "viewer/widgets/format.h"
#include "viewer/widgets/parameter_widgets.h"

namespace etendue::viewer {
namespace {

const char* type_of(const Light& light) {
  constexpr const char* kNames[] = {"point", "spot", "directional", "quad", "disk", "sphere", "ambient"};
  return kNames[static_cast<size_t>(light.type)];
}

void list_lights(Workbench& w, const scene::Scene& scene) {
  for (size_t i = 0; i < scene.lights.size(); ++i) {
    const Light& light = scene.lights[i];
    const std::string name =
        (light.name.empty() ? "light " + std::to_string(i) : light.name) + "  (" + type_of(light) + ")";
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::Selectable(name.c_str(), w.selection.light == static_cast<int>(i)))
      w.selection.light = static_cast<int>(i);
    ImGui::PopID();
    w.items.place("light.choose." + std::to_string(i));
  }
}

void list_emitters(Workbench& w, const scene::Scene& scene) {
  for (size_t i = 0; i < scene.materials.size(); ++i) {
    if (!scene.materials[i].emits()) continue;
    const std::string name =
        scene.materials[i].name.empty() ? "material " + std::to_string(i) : scene.materials[i].name;
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::Selectable((name + "  (surface)").c_str())) {
      w.selection.material = static_cast<int>(i);
      w.show_tab(Tab::material);
    }
    ImGui::PopID();
    w.items.place("light.surface." + std::to_string(i));
    if (ImGui::IsItemHovered()) tooltip(w, "A surface that emits; its emission is set with its material");
  }
}

// Lamps that people know, as steps that can be undone.
void light_presets(Workbench& w, size_t index) {
  const Light& light = w.editor.document().scene->lights[index];
  ParameterInfo info;
  info.name = "light.preset", info.label = "Preset", info.doc = "Gives the light the colour and amount of a lamp";
  info.type = ParameterType::choice, info.default_value = std::string("none");
  info.options = {"none"}, info.option_labels = {"Choose a lamp"};
  for (const LightPreset& preset : kLightPresets)
    if (fits(preset, light)) info.options.emplace_back(preset.name), info.option_labels.emplace_back(preset.label);
  if (info.options.size() < 2) return;
  const auto chosen = loose_widget(w, info);
  for (const LightPreset& preset : kLightPresets) {
    if (!chosen || *chosen != Value(std::string(preset.name))) continue;
    render::Document changed = w.editor.document();
    auto scene = std::make_shared<scene::Scene>(*changed.scene);
    scene->lights[index] = with_preset(light, preset, w.meter.setup.efficacy);
    changed.scene = std::move(scene);
    w.edit(std::move(changed), preset.label);
  }
}

// The same quantity in both units.
void light_figures(Workbench& w, const Light& light) {
  const Efficacy efficacy = w.meter.setup.efficacy;
  const auto both = [&](const char* name, const Rgb& value, const char* unit, const char* photometric_unit) {
    figure(w, name,
           text_of("%.4g %s = %.4g %s", static_cast<double>(luminance(value)), unit, photometric(value, efficacy),
                   photometric_unit));
  };
  const Rgb amount = light.color * light.intensity;
  if (light.type == LightType::point || light.type == LightType::spot) both("Intensity", amount, "W/sr", "cd");
  if (light.type == LightType::directional) both("Irradiance", amount, "W/m\u00b2", "lx");
  if (light.is_surface()) both("Radiance", light.radiance(), "W/(m\u00b2 sr)", "cd/m\u00b2");
  if (const Rgb flux = flux_of(light); !is_black(flux)) both("Flux", flux, "W", "lm");
}

}  // namespace

void draw_light_panel(Workbench& w) {
  const auto scene = w.editor.document().scene;
  const bool surfaces =
      std::any_of(scene->materials.begin(), scene->materials.end(), [](const Material& m) { return m.emits(); });
  if (group(w, "Lights", "light.")) {
    if (scene->lights.empty() && !surfaces)
      note(w, "Nothing in this scene shines by itself; the environment lights it.");
    if (scene->lights.empty() && surfaces && scene->environment.black())
      note(w, "Only shining surfaces light this scene. If it is too dark, load an environment or raise its radiance.");
    list_lights(w, *scene);
    list_emitters(w, *scene);
    if (w.selection.light >= 0 && static_cast<size_t>(w.selection.light) < scene->lights.size()) {
      ImGui::Separator();
      light_presets(w, static_cast<size_t>(w.selection.light));
      section_widgets(w, "light." + std::to_string(w.selection.light));
      light_figures(w, scene->lights[static_cast<size_t>(w.selection.light)]);
    }
  }
  if (group(w, "Light meter", "meter.")) draw_meter(w);
  if (group(w, "Environment", "environment.")) {
    const auto& environment = scene->environment;
    note(w, environment.map       ? environment.file
            : environment.black() ? "Black: no light from outside"
                                  : "The same from everywhere");
    section_widgets(w, "environment");
    action_button(w, "environment.load");
  }
}

}  // namespace etendue::viewer
