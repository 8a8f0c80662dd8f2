// How does radiance become what the screen shows? Nothing here touches the light.
#include <imgui.h>

#include "viewer/layout/interface.h"
#include "viewer/widgets/parameter_widgets.h"

namespace etendue::viewer {

void draw_display_panel(Workbench& w) {
  if (group(w, "Tone", "")) {
    some_widgets(w, "camera", {"exposure"});
    action_button(w, "display.darker");
    ImGui::SameLine();
    action_button(w, "display.brighter");
    section_widgets(w, "display");
  }
  if (group(w, "Look at", "view.")) {
    auto loose = loose_parameters();
    loose[0].default_value = w.view.false_color;
    loose[1].default_value = w.view.aov.empty() ? std::string("picture") : w.view.aov;
    if (const auto value = loose_widget(w, loose[0])) w.view.false_color = std::get<bool>(*value);
    if (const auto value = loose_widget(w, loose[1]))
      w.view.aov = to_string(*value) == "picture" ? "" : to_string(*value);
    if (!w.view.aov.empty())
      note(w, w.aov.busy() ? "The layer is being made..." : "The rendering goes on below this layer.");
  }
  if (group(w, "Picture", "")) {
    const auto& d = w.editor.document();
    figure(w, "Pixels", std::to_string(d.width) + " x " + std::to_string(d.height));
    char text[48];
    std::snprintf(text, sizeof text, "%.0f %%", static_cast<double>(100 * w.view.picture.size.x) / d.width);
    figure(w, "Shown at", text);
    action_button(w, "snapshot.save");
    ImGui::SameLine();
    action_button(w, "snapshot.save-as");
  }
}

}  // namespace etendue::viewer
