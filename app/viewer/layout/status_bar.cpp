#include "viewer/layout/status_bar.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "base/number_text.h"
#include "render/session.h"
#include "render/shared_sampling.h"
#include "viewer/files/file_edits.h"
#include "viewer/files/image_export.h"
#include "viewer/files/loader.h"
#include "viewer/files/scene_export.h"
#include "viewer/files/session_export.h"
#include "viewer/state/app_state.h"
#include "viewer/state/document_info.h"
#include "viewer/tasks/exclusive_task.h"
#include "viewer/viewport/image_zoom.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/status_icon.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

constexpr float kSameScale = 0.01f;  // smaller differences from 100 % are not worth a note

// Parts from left to right, as long as there is space.
class StatusLine {
 public:
  StatusLine(AppState& state, float end) : state_(state), end_(end) {}

  // Moves to the position of the next part. Returns false if there is not enough space for this width.
  bool next(float width) {
    const float gap = ImGui::GetFontSize() * 1.3f;
    if (!first_) {
      if (ImGui::GetItemRectMax().x + gap + width > end_) return false;
      ImGui::SameLine(0, gap);
    }
    first_ = false;
    return true;
  }

  void add(const std::string& text, const char* tooltip_text) {
    if (!next(ImGui::CalcTextSize(text.c_str()).x)) return;
    ImGui::TextUnformatted(text.c_str());
    if (ImGui::IsItemHovered()) tooltip(state_.ui, tooltip_text);
  }

  // An icon that opens the Reliability panel.
  void add_reliability(const render::Reliability& reliability) {
    const auto bias = integrator::find_integrator(state_.document().method.integrator)->bias;
    const bool is_complete = bias == integrator::Bias::unbiased;
    const std::string label =
        std::string(is_complete ? "error" : "noise") + " estimate " + reliability_label(reliability.verdict);
    if (!next(ImGui::GetTextLineHeight() + 4 + ImGui::CalcTextSize(label.c_str()).x)) return;
    ImGui::BeginGroup();
    status_icon(state_.ui, status_of(reliability.verdict));
    ImGui::SameLine(0, 4);
    ImGui::TextUnformatted(label.c_str());
    ImGui::EndGroup();
    state_.ui.items.add("status.reliability");
    if (ImGui::IsItemHovered())
      tooltip(state_.ui, "Whether the stated error can be trusted, not how small it is: " + reliability.reason +
                             (is_complete ? "" : ". The bias of this integrator is not part of it"));
    open_reliability_if_clicked();
  }

  // The error in the measure of the document's limits. A click opens the list of measures.
  void add_error(const std::string& text, film::ErrorMeasure measure) {
    if (!next(ImGui::CalcTextSize(text.c_str()).x)) return;
    ImGui::TextUnformatted(text.c_str());
    state_.ui.items.add("status.error");
    if (ImGui::IsItemHovered())
      tooltip(state_.ui,
              std::string(film::measure_description(measure)) +
                  ". Estimated from the two half-buffers of the film; ? until every pixel has samples in both "
                  "and the image is not black; n/a if the integrator cannot render the scene. Click to choose "
                  "another measure");
    if (ImGui::IsItemClicked()) ImGui::OpenPopup("##measures");
    // Above the bar, whose numbers stay visible.
    ImGui::SetNextWindowPos({ImGui::GetItemRectMin().x, ImGui::GetWindowPos().y}, ImGuiCond_Appearing, {0, 1});
    if (!ImGui::BeginPopup("##measures")) return;
    for (const film::ErrorMeasure choice : film::kErrorMeasures) {
      const Option& option = Options<film::ErrorMeasure>::kOptions[static_cast<size_t>(choice)];
      if (ImGui::MenuItem(option.label, nullptr, choice == measure))
        state_.set_parameter("render.error-measure", std::string(option.name));
      state_.ui.items.add(std::string("status.error.") + option.name);
    }
    ImGui::EndPopup();
  }

  // The scale of the image. A click fits it into the viewport: the enlarged part, or the resolution of the whole image.
  void add_zoom() {
    const bool is_fitted = state_.viewport.zoom.is_fitted();
    const std::string text = formatted("zoom %.0f %%", 100 * static_cast<double>(current_scale(state_)));
    if (!next(ImGui::CalcTextSize(text.c_str()).x)) return;
    ImGui::TextUnformatted(text.c_str());
    state_.ui.items.add("status.zoom");
    if (ImGui::IsItemHovered())
      tooltip(state_.ui,
              is_fitted ? "Zoom of the image, whose resolution is not that of the viewport. Click to render it in the "
                          "resolution of the viewport"
                        : "Zoom of the image. Click to fit it into the viewport");
    if (!ImGui::IsItemClicked()) return;
    if (is_fitted)
      state_.actions.find("view.fit")->run(state_);
    else
      set_scale(state_, 0);
  }

  // The number of invalid samples. A click opens the Reliability panel.
  void add_invalid(uint64_t count) {
    const std::string text = formatted("%llu invalid", static_cast<unsigned long long>(count));
    if (!next(ImGui::CalcTextSize(text.c_str()).x)) return;
    ImGui::TextColored(state_.ui.theme.warning, "%s", text.c_str());
    if (ImGui::IsItemHovered())
      tooltip(state_.ui, "Infinite, NaN or negative samples; they count as black. Click for their pixels");
    open_reliability_if_clicked();
  }

 private:
  void open_reliability_if_clicked() {
    const Action* action = state_.actions.find("view.panel.reliability");
    if (ImGui::IsItemClicked() && action) action->run(state_);
  }

  AppState& state_;
  float end_;
  bool first_ = true;
};

// Whether a file is being written.
bool is_saving(const AppState& state) {
  const FileState& files = state.files;
  return files.image_export->is_busy() || files.scene_export->is_busy() || files.session_export->is_busy() ||
         files.material_save.running();
}

std::string phase_text(const AppState& state, const render::Status& status) {
  if (is_saving(state)) return "Saving";
  if (state.files.edits->is_busy()) return "Reading";
  const std::string exclusive = state.tasks.exclusive->status();
  std::string text = exclusive.empty() ? status.phase : exclusive;
  if (text.empty()) text = "starting";
  if (status.phase_progress > 0) text += formatted(" %.0f %%", 100 * status.phase_progress);
  return text;
}

std::string error_text(const render::Status& status) {
  const std::string label = film::measure_label(status.measure);
  if (!status.incompatibility.empty()) return label + " n/a";
  const film::MeasuredError& error = status.measured_error;
  return label + " " + (error.known ? film::error_text(status.measure, error.value) : "?");
}

// "4 ranks", or "3 of 4 ranks" if some take no part.
void add_ranks(StatusLine& line, const render::SharingStatus& status) {
  const std::string all = formatted("%d ranks", status.ranks);
  const std::string text = status.active < status.ranks ? formatted("%d of ", status.active) + all : all;
  const uint32_t samples = status.own_samples + status.other_samples;
  const std::string share =
      samples > 0 ? formatted("; %.0f %% of the samples are from other ranks", 100.0 * status.other_samples / samples)
                  : std::string();
  line.add(text,
           ("Processes that render this image" + share + (status.note.empty() ? "" : ". ") + status.note).c_str());
}

std::string speed_text(const render::Status& status) {
  return formatted("%.2f Ms/s, %.1f Mr/s", status.paths_per_second / 1e6, status.rays_per_second / 1e6);
}

// What describes the renderer but calls for no action.
std::string details_text(const AppState& state, const render::Status& status) {
  return formatted("%.2f million samples and %.1f million rays per second\n", status.paths_per_second / 1e6,
                   status.rays_per_second / 1e6) +
         "Memory of scene, film and integrator: " + format_bytes(status.memory) +
         "\nFeatures in use: " + state.session->model().summary();
}

void draw_parts(AppState& state, StatusLine& line) {
  const render::Status status = state.session->status();
  const uint32_t limit = state.document().limits.samples;
  const std::string details = details_text(state, status);
  line.add(phase_text(state, status), ("What the renderer is doing\n" + details).c_str());
  if (const render::AutomaticMethod& automatic = state.document().automatic; automatic.enabled)
    line.add("Automatic: " + integrator_label(state.document().method.integrator),
             automatic.is_pending() ? "The integrator is chosen automatically when the image has rested for a moment"
                                    : ("Chosen automatically: " + automatic.reason).c_str());
  if (status.incompatibility.empty())
    line.add(limit > 0 ? formatted("%u / %u spp", status.samples, limit) : formatted("%u spp", status.samples),
             ("Samples per pixel\n" + details).c_str());
  if (!state.viewport.zoom.is_fitted() || std::abs(current_scale(state) - 1) > kSameScale) line.add_zoom();
  line.add(clock_text(status.seconds), "Rendering time of this image");
  if (status.time_left && !status.finished)
    line.add(remaining_time(status.time_left->seconds, status.time_left->interval.low, status.time_left->interval.high),
             "Predicted time to the limit. With an error limit, the range is an 80 % prediction interval");
  line.add_error(error_text(status), status.measure);
  if (status.focus && status.focus->error.known)
    line.add(
        "region " + film::error_text(status.measure, status.focus->error.value),
        formatted("The same error of the region of interest, which has %u samples per pixel", status.focus->samples)
            .c_str());
  if (status.reliability) line.add_reliability(*status.reliability);
  if (status.rejected.total() > 0) line.add_invalid(status.rejected.total());
  if (state.options.sharing) add_ranks(line, state.options.sharing->status());
  if (!state.settings.show_details) return;
  line.add(speed_text(status), "Million samples and million rays per second");
  line.add(format_bytes(status.memory),
           "Memory of the scene, its acceleration structures, the film and the integrator");
  line.add(formatted("UI %.0f %%", 100 * state.timing.interface_share),
           "Share of the time that drawing the interface takes");
  line.add(state.session->model().summary(), "Features in use: only those that the scene needs");
}

}  // namespace

void draw_status_bar(AppState& state, float top, float height) {
  const float width = ImGui::GetIO().DisplaySize.x;
  ImGui::SetNextWindowPos({0, top});
  ImGui::SetNextWindowSize({width, height});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, state.ui.theme.background);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {10 * state.ui.scale, 4});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
  ImGui::Begin("##status", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoBringToFrontOnFocus);
  ImGui::PushFont(state.ui.fonts.monospace);
  if (!state.has_document()) {
    ImGui::TextUnformatted(state.files.loader->is_busy() ? "opening" : "no scene");
  } else {
    const double progress = state.session->status().progress;
    if (progress > 0) {
      const ImVec2 size{ImGui::GetFontSize() * 6, ImGui::GetFontSize() * 0.9f};
      // Without padding, which would move the text beside the bar downwards.
      ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0, 0});
      ImGui::ProgressBar(static_cast<float>(progress), size, "");
      ImGui::PopStyleVar();
      ImGui::SameLine();
    }
    StatusLine line(state, width - 10 * state.ui.scale);
    draw_parts(state, line);
  }
  ImGui::PopFont();
  ImGui::End();
  ImGui::PopStyleVar(2);
  ImGui::PopStyleColor();
}

}  // namespace etendue::viewer
