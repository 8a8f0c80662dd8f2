// The drawer under the picture: sheets of figures about it, one open at a time, pulled out by its tab and pushed back
// by the same.
#pragma once
#include <functional>

#include "viewer/state/app_state.h"

namespace etendue::viewer {

struct SheetInfo {
  const char* name;  // of its tab: "sheet.health"
  const char* label;
  const char* doc;
  void (*draw)(Workbench&);
};
// Every sheet, from left to right; one line each.
const std::vector<SheetInfo>& sheets();

void draw_convergence_sheet(Workbench& w);
void draw_health_sheet(Workbench& w);
void draw_paths_sheet(Workbench& w);
void draw_techniques_sheet(Workbench& w);
void draw_sampling_sheet(Workbench& w);
void draw_surface_sheet(Workbench& w);
// The settings of the sampling sheet, as scripts see them.
std::vector<ParameterInfo> sampling_parameters();

// What a sheet shows with its controls on the right, this wide; below it where that would leave less than twice as
// much.
void with_controls(Workbench& w, float width, const std::function<void()>& shown, void (*controls)(Workbench&));

// Draws it on the lower edge of a region from the window's left side to `right`; returns its height.
float draw_drawer(Workbench& w, float top, float right, float bottom);

}  // namespace etendue::viewer
