// Where does the light come from, and how much of it?
#include <imgui.h>

#include "light/area_light.h"
#include "light/light_presets.h"
#include "viewer/panels.h"
#include "viewer/widgets.h"
#include "viewer/words.h"

namespace etendue::viewer {
namespace {

void list_lights(Workbench& w, const scene::Scene& scene) {
  for (size_t i = 0; i < scene.lights.size(); ++i) {
    const Light& light = scene.lights[i];
    const std::string name =
        (light.name.empty() ? "light " + std::to_string(i) : light.name) + "  (" + light.info().description.name + ")";
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::Selectable(name.c_str(), w.selection.light == static_cast<int>(i)))
      w.selection.light = static_cast<int>(i);
    ImGui::PopID();
    w.items.place("light.choose." + std::to_string(i));
  }
}

void list_emitters(Workbench& w, const scene::Scene& scene) {
  for (size_t i = 0; i < scene.materials.size(); ++i) {
    if (!scene.materials[i].is_emissive()) continue;
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

// "W/m^2" with a superscript.
std::string typeset(std::string unit) {
  if (const size_t at = unit.find("^2"); at != std::string::npos) unit.replace(at, 2, "\u00b2");
  return unit;
}

// The same quantity in both units.
void light_figures(Workbench& w, const Light& light) {
  const Efficacy efficacy = w.meter.setup.efficacy;
  const auto both = [&](const char* name, const Rgb& value, const char* unit, const char* photometric_unit) {
    figure(w, name,
           text_of("%.4g %s = %.4g %s", static_cast<double>(luminance(value)), unit, photometric(value, efficacy),
                   photometric_unit));
  };
  const RadiometricQuantity& quantity = *light.info().description.quantity;
  const auto surface = light.model->area_light(light.color);
  both(quantity.name, surface ? surface->radiance : light.color * light.intensity(), typeset(quantity.unit).c_str(),
       typeset(quantity.photometric_unit).c_str());
  if (const Rgb flux = light.flux(); !is_black(flux)) both("Flux", flux, "W", "lm");
}

}  // namespace

void draw_light_panel(Workbench& w) {
  const auto scene = w.editor.document().scene;
  const bool surfaces =
      std::any_of(scene->materials.begin(), scene->materials.end(), [](const Material& m) { return m.is_emissive(); });
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
