// How much light is there, in watts and in lumens?
#include <imgui.h>

#include "viewer/layout/interface.h"
#include "viewer/widgets/format.h"
#include "viewer/widgets/parameter_widgets.h"

namespace etendue::viewer {
namespace {

void reading(Workbench& w, const char* name, const render::Reading& r, const char* unit, const char* photometric_unit) {
  const double y = static_cast<double>(luminance(r.value)), factor = lumens_per_watt(w.meter.setup.efficacy);
  figure(w, name, text_of("%.4g \u00b1 %.1g %s", y, r.standard_error, unit));
  figure(w, "", text_of("%.4g \u00b1 %.1g %s", factor * y, factor * r.standard_error, photometric_unit));
}

}  // namespace

void draw_meter(Workbench& w) {
  action_button(w, "meter.pick");
  for (const ParameterInfo& info : meter_parameters(w.meter.setup))
    if (const auto value = loose_widget(w, info)) assign_by_name(w.meter.setup.knobs(), info.name, *value);
  if (w.meter.picks) return note(w, "Click a surface in the picture.");
  const auto* m = w.meter.shown();
  if (!m) {
    if (w.meter.place()) note(w, "It sees nothing but the sky, or is about to be read.");
    return;
  }
  reading(w, "Radiance", m->radiance, "W/(m\u00b2 sr)", "cd/m\u00b2");
  reading(w, "Irradiance", m->irradiance, "W/m\u00b2", "lx");
  if (!is_black(m->emitted_flux)) reading(w, "Emitted flux", {m->emitted_flux, 0}, "W", "lm");
  note(w, w.meter.whole() ? "To the eye, and onto the surface from the eye's side; emitted by the whole object."
                          : "More samples are being taken.");
}

void draw_meter_marker(Workbench& w, ImDrawList* draw) {
  if (!w.meter.place() || w.view.tab != Tab::light || !w.view.interface) return;
  const Vec2 size(w.editor.document().width, w.editor.document().height);
  const Placement& p = w.view.picture;
  const Vec2 at = p.corner + *w.meter.place() * p.size / size;
  const float r = ImGui::GetFontSize() * 0.5f;
  for (const auto& [color, width] :
       {std::pair{IM_COL32(0, 0, 0, 170), 3.5f}, std::pair{IM_COL32(255, 220, 80, 255), 1.5f}}) {
    draw->AddCircle({at.x, at.y}, r, color, 0, width);
    draw->AddLine({at.x - 0.3f * r, at.y}, {at.x + 0.3f * r, at.y}, color, width);
    draw->AddLine({at.x, at.y - 0.3f * r}, {at.x, at.y + 0.3f * r}, color, width);
  }
}

}  // namespace etendue::viewer
