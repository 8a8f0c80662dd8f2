// How reliable the error estimate of the image is: tail statistics and invalid samples.
#include <imgui.h>

#include <nlohmann/json.hpp>

#include "render/session.h"
#include "viewer/panels/panel.h"
#include "viewer/state/app_state.h"
#include "viewer/state/document_info.h"
#include "viewer/widgets/action_widgets.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/status_icon.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

using Count = unsigned long long;

void verdict_line(const AppState& state, const render::Status& status) {
  const UiContext& ui = state.ui;
  const render::Reliability* reliability = status.reliability.get();
  if (!status.incompatibility.empty())
    return warning(ui, "There is no image to assess: " + with_labels(state.document(), status.incompatibility).text);
  if (!reliability)
    return note(
        ui, "Not known yet: the first assessment needs about ten samples per pixel and an image that is not black.");
  status_icon(ui, status_of(reliability->verdict));
  ImGui::SameLine();
  const std::string text =
      std::string("Error estimate ") + reliability_label(reliability->verdict) + ": " + reliability->reason;
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
}

void error_values(const UiContext& ui, const render::Status& status) {
  const film::ErrorEstimate& error = status.error;
  const char* unknown = status.incompatibility.empty() ? "not known yet" : "n/a";
  if (status.measure != film::ErrorMeasure::rmse) {
    const film::MeasuredError& e = status.measured_error;
    const auto text = [&](double value) { return film::error_text(status.measure, value); };
    labelled_value(
        ui, Options<film::ErrorMeasure>::kOptions[static_cast<size_t>(status.measure)].label,
        e.known ? text(e.value) + " (" + text(e.interval.low) + " to " + text(e.interval.high) + ")" : unknown,
        film::measure_description(status.measure));
  }
  labelled_value(
      ui, "RMSE",
      error.known ? formatted("%.3g (%.3g to %.3g)", error.rmse, error.rmse_interval.low, error.rmse_interval.high)
                  : unknown,
      "Root mean square error, estimated from the two half-buffers of the film, with its 95 % confidence interval");
}

void tail_values(const UiContext& ui, const render::Reliability& reliability) {
  const film::Tail& tail = reliability.tail;
  labelled_value(ui, "Tail index", tail.khat ? formatted("%.2f \u00b1 %.2f", *tail.khat, tail.khat_error) : "no tail",
                 "Pareto shape k of the largest samples. From 0.5 on the variance is infinite; above 0.7 error "
                 "estimates are meaningless");
  labelled_value(ui, "Heavy-tailed", formatted("%.2g %% of the image", 100 * reliability.heavy_share),
                 "Share of the image where the tail index is too high and few samples dominate the noise. View > "
                 "Overlays > Show unreliable regions marks these tiles");
  labelled_value(ui, "Variance of variance", formatted("%.2g", tail.vov),
                 "Relative variance of the variance estimate. Above 0.1 the error is not known yet");
  const char* bound = tail.brightest_share_is_lower_bound ? "more than " : "";
  labelled_value(ui, "Brightest 0.01 %", formatted("%s%.2g %% of the light", bound, 100 * tail.brightest_share),
                 "Share of the total radiance in the brightest 0.01 % of the samples");
}

void invalid_sample_values(const UiContext& ui, const film::InvalidSamples& invalid) {
  const char* description = "Samples that are not finite or negative. They are counted and left out";
  if (invalid.total() == 0) return labelled_value(ui, "Invalid samples", "none", description);
  labelled_value(ui, "Invalid samples",
                 formatted("%llu NaN, %llu infinite, %llu negative", static_cast<Count>(invalid.nan),
                           static_cast<Count>(invalid.infinite), static_cast<Count>(invalid.negative)),
                 description);
  for (const film::InvalidSample& sample : invalid.first)
    note(ui, formatted("pixel %d, %d, sample %u: %s", sample.x, sample.y, sample.sample,
                       std::string(film::reason_name(sample.reason)).c_str()));
}

class ReliabilityPanel final : public Panel {
 public:
  PanelInfo info() const override {
    return {.name = "panel.reliability",
            .label = "Reliability",
            .description = "Whether the error estimate can be trusted: outliers, tail statistics and invalid samples",
            .place = PanelPlace::bottom};
  }

  void draw(AppState& state) override {
    const UiContext& ui = state.ui;
    const render::Status status = state.session->status();
    verdict_line(state, status);
    ImGui::Spacing();
    if (!ImGui::BeginTable("##reliability", 2, ImGuiTableFlags_SizingStretchSame)) return;
    ImGui::TableNextColumn();
    error_values(ui, status);
    invalid_sample_values(ui, status.rejected);
    ImGui::TableNextColumn();
    if (status.reliability) tail_values(ui, *status.reliability);
    action_button(state, "view.reliability-map");
    ImGui::EndTable();
  }

  void report(AppState& state, nlohmann::json& json) override {
    const render::Status status = state.session->status();
    if (status.error.known) json["rmse"] = status.error.rmse;
    if (status.measured_error.known) json["error"] = status.measured_error.value;
    json["error_measure"] = Options<film::ErrorMeasure>::kOptions[static_cast<size_t>(status.measure)].name;
    if (!status.reliability) return;
    const auto& reliability = *status.reliability;
    json["health"] = {{"verdict", render::verdict_name(reliability.verdict)}, {"reason", reliability.reason}};
  }
};

}  // namespace

std::unique_ptr<Panel> make_reliability_panel() { return std::make_unique<ReliabilityPanel>(); }

}  // namespace etendue::viewer
