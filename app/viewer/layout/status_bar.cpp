// How far is the picture, how fast does it go, and what does it cost?
#include <imgui.h>

#include "viewer/layout/interface.h"
#include "viewer/widgets/format.h"
#include "viewer/widgets/parameter_widgets.h"
#include "viewer/widgets/status_icon.h"

namespace etendue::viewer {
namespace {

// "0:48 +- 0:06 left": the longer side of the interval, it leans to the late.
std::string left_text(const render::Prediction& left) {
  if (left.seconds > 100 * 3600) return "days left";
  const double off = std::max(left.interval.high - left.seconds, left.seconds - left.interval.low);
  return time_text(left.seconds) + (off >= 1 ? " \u00b1 " + time_text(off) : "") + " left";
}

// Parts from left to right, as long as there is room.
class Line {
 public:
  explicit Line(float end) : end_(end) {}

  // Whether there is room for a part of this width; the next item is it.
  bool next(float width) {
    if (!first_) {
      const float gap = ImGui::GetFontSize() * 1.3f;
      if (ImGui::GetItemRectMax().x + gap + width > end_) return false;
      ImGui::SameLine(0, gap);
    }
    first_ = false;
    return true;
  }

  void part(Workbench& w, const std::string& text, const char* doc, bool warns = false) {
    if (!next(ImGui::CalcTextSize(text.c_str()).x)) return;
    if (warns)
      ImGui::TextColored(w.theme.warning, "%s", text.c_str());
    else
      ImGui::TextUnformatted(text.c_str());
    if (ImGui::IsItemHovered()) tooltip(w, doc);
  }

 private:
  float end_;
  bool first_ = true;
};

// A click opens the sheet with the reasons.
void health_part(Workbench& w, Line& line, const render::Reliability& health) {
  const std::string verdict(render::verdict_name(health.verdict));
  if (!line.next(ImGui::GetTextLineHeight() + 4 + ImGui::CalcTextSize(verdict.c_str()).x)) return;
  ImGui::BeginGroup();
  traffic_light(w, health.verdict);
  ImGui::SameLine(0, 4);
  ImGui::TextUnformatted(verdict.c_str());
  ImGui::EndGroup();
  w.items.place("status.health");
  if (ImGui::IsItemHovered()) tooltip(w, health.reason);
  if (ImGui::IsItemClicked()) w.view.sheet = w.view.sheet == "sheet.health" ? "" : "sheet.health";
}

void status_parts(Workbench& w, Line& line) {
  const render::Status status = w.session.status();
  const auto& d = w.editor.document();
  std::string phase = w.contest.running() ? "comparing" : status.phase;
  if (status.phase_progress > 0) phase += text_of(" %.0f %%", 100 * status.phase_progress);
  line.part(w, phase.empty() ? "starting" : phase, "What the renderer is doing");
  std::string samples = text_of("%u spp", status.samples);
  if (d.limits.samples > 0) samples = text_of("%u / %u spp", status.samples, d.limits.samples);
  line.part(w, samples, "Complete samples of every pixel");
  line.part(w, time_text(status.seconds), "Time spent on this picture");
  if (status.left && !status.finished)
    line.part(w, left_text(*status.left),
              "Until it stops; how far that may be off, in four of five cases, where it stops at an error");
  line.part(w, text_of("%.2f Ms/s", status.paths_per_second / 1e6), "Million samples per second");
  line.part(w, text_of("%.1f Mr/s", status.rays_per_second / 1e6), "Million rays per second");
  line.part(w, memory_text(status.memory),
            "Memory of the scene, its acceleration structures, the film and what the method keeps");
  const std::string error = status.error.known ? text_of("rmse %.2g", status.error.rmse) : "rmse ?";
  line.part(w, error,
            "Estimated root mean square error of the picture, from its two independent halves; not known before every "
            "pixel has samples in both");
  if (status.health) health_part(w, line, *status.health);
  if (status.rejected.total() > 0)
    line.part(w, text_of("%llu rejected", static_cast<unsigned long long>(status.rejected.total())),
              "Samples that were no radiance (not finite, or negative) and were left out", true);
  line.part(w, text_of("ui %.0f %%", 100 * w.pace.share), "Share of the time that the interface takes");
  line.part(w, w.session.model().summary(), "The model in use: no more physics than the scene needs");
}

}  // namespace

void draw_status_bar(Workbench& w, float top, float height) {
  const float width = ImGui::GetIO().DisplaySize.x;
  ImGui::SetNextWindowPos({0, top});
  ImGui::SetNextWindowSize({width, height});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, w.theme.ground);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {10, 4});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
  ImGui::Begin("##status", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoBringToFrontOnFocus);
  ImGui::PushFont(w.faces.figures);
  if (w.editor.empty()) {
    ImGui::TextUnformatted(w.loader.busy() ? "opening" : "no scene");
  } else {
    const double progress = w.session.status().progress;
    if (progress > 0) {
      ImGui::ProgressBar(static_cast<float>(progress), {ImGui::GetFontSize() * 6, ImGui::GetFontSize() * 0.9f}, "");
      ImGui::SameLine();
    }
    Line line(width - 10);
    status_parts(w, line);
  }
  ImGui::PopFont();
  ImGui::End();
  ImGui::PopStyleVar(2);
  ImGui::PopStyleColor();
}

}  // namespace etendue::viewer
