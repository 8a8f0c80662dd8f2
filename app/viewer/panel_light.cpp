// Where does the light come from, and how much of it?
#include <imgui.h>

#include "viewer/panels.h"
#include "viewer/widgets.h"

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
      section_widgets(w, "light." + std::to_string(w.selection.light));
    }
  }
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
