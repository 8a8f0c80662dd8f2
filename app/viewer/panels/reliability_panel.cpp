// How far can the picture be trusted?
#include <imgui.h>

#include "viewer/layout/bottom_panel.h"
#include "viewer/widgets/format.h"
#include "viewer/widgets/parameter_widgets.h"
#include "viewer/widgets/status_icon.h"

namespace etendue::viewer {
namespace {

using Count = unsigned long long;

void verdict_line(Workbench& w, const render::Reliability* health) {
  if (!health) return note(w, "The samples are watched; the first verdict comes after ten of them.");
  traffic_light(w, health->verdict);
  ImGui::SameLine();
  const std::string verdict(render::verdict_name(health->verdict));
  ImGui::Text("%s: %s", verdict.c_str(), health->reason.c_str());
}

void error_figures(Workbench& w, const film::ErrorEstimate& error) {
  figure(w, "RMSE",
         error.known ? text_of("%.3g  (%.3g to %.3g)", error.rmse, error.rmse_interval.low, error.rmse_interval.high)
                     : "not yet known");
  if (ImGui::IsItemHovered())
    tooltip(w, "From the picture's two independent halves; in 95 of 100 cases the true error lies within the brackets");
  figure(w, "relMSE", error.known ? text_of("about %.1g", error.rough_relmse) : "not yet known");
  if (ImGui::IsItemHovered())
    tooltip(w,
            "Rough, and up to a third too low: divided by the picture instead of the truth. The certificate of etendue "
            "render states it with an interval");
}

void tail_figures(Workbench& w, const render::Reliability& health) {
  const film::Tail& t = health.tail;
  const auto line = [&](const char* name, const std::string& value, const char* doc) {
    figure(w, name, value);
    if (ImGui::IsItemHovered()) tooltip(w, doc);
  };
  line("Tail index", t.khat ? text_of("%.2f \u00b1 %.2f", *t.khat, t.khat_error) : "no tail",
       "Pareto k of the rarest samples: from 0.5 on their variance is infinite, above 0.7 an error that is told from "
       "them means nothing");
  line("Heavy tiles", text_of("%.2g %% of the picture", 100 * health.heavy_share),
       "Where the tail index is too high and a few samples carry the noise; the map shows them");
  line("Variance of variance", text_of("%.2g", t.vov),
       "Relative variance of the variance: above 0.1 the error is not yet known");
  line("Brightest", text_of("%s%.2g %% of the light", t.brightest_is_bound ? "more than " : "", 100 * t.brightest),
       "What the brightest 0.01 % of the samples carry");
}

void rejected_figures(Workbench& w, const film::InvalidSamples& r) {
  if (r.total() == 0) return figure(w, "Rejected", "none");
  figure(w, "Rejected",
         text_of("%llu not a number, %llu infinite, %llu negative", static_cast<Count>(r.nan),
                 static_cast<Count>(r.infinite), static_cast<Count>(r.negative)));
  for (const film::Rejection& first : r.first)
    note(w, text_of("pixel %d, %d, sample %u: %s", first.x, first.y, first.sample,
                    std::string(film::flaw_name(first.flaw)).c_str()));
}

}  // namespace

void draw_health_sheet(Workbench& w) {
  const render::Status status = w.session.status();
  verdict_line(w, status.health.get());
  ImGui::Spacing();
  if (!ImGui::BeginTable("##health", 2, ImGuiTableFlags_SizingStretchSame)) return;
  ImGui::TableNextColumn();
  error_figures(w, status.error);
  rejected_figures(w, status.rejected);
  ImGui::TableNextColumn();
  if (status.health) tail_figures(w, *status.health);
  action_button(w, "view.health-map");
  ImGui::EndTable();
}

}  // namespace etendue::viewer
