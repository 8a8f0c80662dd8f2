// How far can the picture be trusted?
#include <imgui.h>

#include "viewer/drawer.h"
#include "viewer/words.h"
#include "viewer/widgets.h"

namespace etendue::viewer {
namespace {

void error_figures(Workbench& w, const film::ErrorEstimate& error) {
  const auto line = [&](const char* name, double value, const film::Interval& interval) {
    figure(w, name, error.known ? text_of("%.3g  (%.3g to %.3g)", value, interval.low, interval.high) : "not yet known");
  };
  line("RMSE", error.rmse, error.rmse_interval);
  line("relMSE", error.relmse, error.relmse_interval);
  note(w, "Estimated from the picture's two independent halves; the true error lies within the brackets in 95 of 100 cases.");
}

}  // namespace

void draw_health_sheet(Workbench& w) {
  const render::Status status = w.session.status();
  error_figures(w, status.error);
  const auto& r = status.rejected;
  figure(w, "Rejected", r.total() == 0 ? "none" : text_of("%llu not a number, %llu infinite, %llu negative", static_cast<unsigned long long>(r.nan), static_cast<unsigned long long>(r.infinite), static_cast<unsigned long long>(r.negative)));
}

}  // namespace etendue::viewer
