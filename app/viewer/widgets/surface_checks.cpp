#include "viewer/widgets/surface_checks.h"

#include <imgui.h>

#include "viewer/tasks/surface_analysis.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/status_icon.h"

namespace etendue::viewer {

void draw_surface_checks(UiContext& ui, const SurfaceMeasurement* measurement) {
  if (!measurement) {
    constexpr int kChecks = 4;
    for (int i = 0; i < kChecks; ++i) ImGui::TextDisabled("%s", i == 0 ? "Checking the surface..." : "");
    return;
  }
  for (const bsdf_analysis::Check& check : measurement->audit.checks) {
    status_icon(ui, check.holds ? Status::good : Status::doubtful);
    ImGui::SameLine();
    ImGui::TextColored(check.holds ? ui.theme.text : ui.theme.warning, "%s", check.label());
    ui.items.add(std::string("surface.check.") + check.name);
    if (ImGui::IsItemHovered()) tooltip(ui, std::string(check.label()) + ": " + check.reason);
  }
}

}  // namespace etendue::viewer
