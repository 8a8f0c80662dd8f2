// Histograms and waveform of the image: the distribution of the linear luminance and of the displayed values.
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "render/display_frame.h"
#include "render/document.h"
#include "viewer/panels/panel.h"
#include "viewer/state/app_state.h"
#include "viewer/tasks/histogram_task.h"
#include "viewer/viewport/aov_layer.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/plot.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

// Red, green and blue that are distinguishable on a dark and on a light background.
const std::array<ImVec4, 3> kChannelColors{
    {{0.89f, 0.29f, 0.24f, 1}, {0.22f, 0.68f, 0.33f, 1}, {0.27f, 0.5f, 0.93f, 1}}};
constexpr std::array<const char*, 3> kChannelNames{"Red", "Green", "Blue"};
constexpr const char* kBeauty = "beauty";

double largest(const auto& counts) {
  return counts.empty() ? 0 : static_cast<double>(*std::ranges::max_element(counts));
}

// The number of pixels is on a logarithmic axis, so that few bright pixels are visible.
PlotAxis count_axis(double max) { return {.logarithmic = true, .low = 0.7, .high = std::max(10.0, 1.5 * max)}; }

void draw_luminance_histogram(const UiContext& ui, ImDrawList* draw, const Placement& frame, const ImageStatistics& s) {
  const auto& counts = s.luminance_counts;
  const double low = s.low_stops();
  const double bins = std::max<double>(1, static_cast<double>(counts.size()));
  const PlotAxis x{.logarithmic = false, .low = low, .high = low + bins / kBinsPerStop};
  const Plot plot(ui, draw, frame, "Luminance (log2 cd/m\u00b2)", x, count_axis(largest(counts)));
  plot.draw_axes();
  const Placement& area = plot.area();
  const auto width = area.size.x / static_cast<float>(bins);
  const float gap = width > 4 ? 0.5f : 0;
  for (size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] == 0) continue;
    const float left = area.corner.x + width * static_cast<float>(i);
    draw->AddRectFilled({left + gap, plot.at(x.low, static_cast<double>(counts[i])).y},
                        {left + width - gap, area.corner.y + area.size.y}, ImGui::GetColorU32(ui.theme.accent));
  }
}

void draw_displayed_histogram(const UiContext& ui, ImDrawList* draw, const Placement& frame, const ImageStatistics& s) {
  double max = 0;
  for (const auto& channel : s.displayed_counts) max = std::max(max, largest(channel));
  const PlotAxis x{.logarithmic = false, .low = 0, .high = kDisplayLevels - 1};
  const Plot plot(ui, draw, frame, "Displayed value", x, count_axis(max));
  plot.draw_axes();
  for (size_t k = 0; k < 3; ++k) {
    std::vector<ImVec2> points;
    for (size_t i = 0; i < kDisplayLevels; ++i)
      points.push_back(plot.at(static_cast<double>(i), std::max(0.7, static_cast<double>(s.displayed_counts[k][i]))));
    plot.draw_curve(points, ImGui::GetColorU32(kChannelColors[k]), 1.3f);
  }
}

// The brightness of a cell of the waveform: 1 for the largest number of pixels.
float brightness(uint32_t count, double max) {
  return static_cast<float>(std::log1p(static_cast<double>(count)) / std::log1p(max));
}

void draw_waveform(const UiContext& ui, ImDrawList* draw, const Placement& frame, const ImageStatistics& s) {
  const PlotAxis x{.logarithmic = false, .low = 0, .high = 1};
  const PlotAxis y{.logarithmic = false, .low = 0, .high = kDisplayLevels};
  const Plot plot(ui, draw, frame, "Waveform", x, y);
  const Placement& area = plot.area();
  draw->AddRectFilled({area.corner.x, area.corner.y}, {area.corner.x + area.size.x, area.corner.y + area.size.y},
                      IM_COL32(0, 0, 0, 255));
  double max = 1;
  for (const auto& channel : s.waveform) max = std::max(max, largest(channel));
  const Vec2 cell = area.size / Vec2(std::max(s.columns, 1), kWaveformLevels);
  for (int column = 0; column < s.columns; ++column)
    for (int level = 0; level < kWaveformLevels; ++level) {
      const auto i = static_cast<size_t>(column * kWaveformLevels + level);
      if (s.waveform[0][i] + s.waveform[1][i] + s.waveform[2][i] == 0) continue;
      const ImVec4 color{brightness(s.waveform[0][i], max), brightness(s.waveform[1][i], max),
                         brightness(s.waveform[2][i], max), 1};
      const Vec2 corner = area.corner + Vec2(column, kWaveformLevels - 1 - level) * cell;
      draw->AddRectFilled({corner.x, corner.y}, {corner.x + cell.x, corner.y + cell.y}, ImGui::GetColorU32(color));
    }
  plot.draw_axes();
}

std::string share_text(double share) { return formatted("%.3g %%", 100 * share); }

void draw_values(const UiContext& ui, const ImageStatistics& s) {
  const double pixels = static_cast<double>(std::max<uint64_t>(1, s.pixels));
  labelled_value(ui, "Black", share_text(static_cast<double>(s.black) / pixels), "Pixels without any light");
  labelled_value(ui, "Above white", share_text(s.above_white),
                 "Pixels with a channel above 1 after exposure, before the tone curve");
  for (size_t k = 0; k < 3; ++k)
    labelled_value(ui, (std::string(kChannelNames[k]) + " 0 / 255").c_str(),
                   share_text(s.clipped_low[k]) + " / " + share_text(s.clipped_high[k]),
                   "Pixels whose displayed value is clipped at 0 and at 255");
  if (s.invalid > 0)
    labelled_value(ui, "Not finite", formatted("%llu", static_cast<unsigned long long>(s.invalid)),
                   "Pixels that are not finite; no other number counts them");
}

class HistogramPanel final : public Panel {
 public:
  PanelInfo info() const override {
    return {.name = "panel.histogram",
            .label = "Histogram",
            .description = "Histograms of luminance and displayed values, waveform, and clipped pixels",
            .place = PanelPlace::bottom};
  }

  void draw(AppState& state) override {
    const ImageStatistics* statistics = task_.result();
    if (!statistics) return note(state.ui, "Counting the pixels of the first image.");
    const float em = ImGui::GetFontSize();
    const float height = ImGui::GetContentRegionAvail().y;
    ImGui::BeginChild("##values", {em * 17, 0});
    labelled_value(state.ui, "Image", source_ == kBeauty ? "Beauty" : label_of_name(source_),
                   "What the charts describe: the image, or the AOV that is shown instead of it");
    draw_values(state.ui, *statistics);
    ImGui::EndChild();
    ImGui::SameLine(0, em);
    ImGui::BeginChild("##charts");
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x / 3;
    const auto frame = [&](int i) {
      return Placement{{corner.x + width * static_cast<float>(i), corner.y}, {width, height}};
    };
    ImDrawList* draw = ImGui::GetWindowDrawList();
    draw_luminance_histogram(state.ui, draw, frame(0), *statistics);
    draw_displayed_histogram(state.ui, draw, frame(1), *statistics);
    draw_waveform(state.ui, draw, frame(2), *statistics);
    ImGui::EndChild();
  }

  std::vector<WaitCondition> wait_conditions() override {
    const auto check = [this](AppState& state, std::optional<uint32_t>) -> StepStatus {
      if (!state.panels.is_open(*this)) return {.error = "the histogram panel is closed; click panel.histogram first"};
      const bool is_shown = source_ == kBeauty ? state.viewport.aov_name.empty() : source_ == state.viewport.aov_name;
      return {.done = is_shown && task_.is_current()};
    };
    return {{.name = "histogram", .check = check, .needs_frames = true}};
  }

  void report(AppState&, nlohmann::json& json) override {
    const ImageStatistics* s = task_.result();
    if (!s) return;
    json["histogram"] = {{"source", source_},             {"pixels", s->pixels},
                         {"black", s->black},             {"invalid", s->invalid},
                         {"above_white", s->above_white},
                         {"clipped_low", s->clipped_low}, {"clipped_high", s->clipped_high}};
  }

  void update(AppState& state) override {
    if (!state.panels.is_open(*this)) return task_.pause();
    source_ = state.shows_aov() ? state.viewport.aov_name : kBeauty;
    task_.update(state.task_context, state.shows_aov() ? input_of_aov(state) : input_of_image(state));
  }

  std::vector<Task*> tasks() override { return {&task_}; }

 private:
  // Identifies an image of an AOV.
  struct AovKey {
    std::string name;
    uint64_t version = 0;
    uint32_t samples = 0;

    friend bool operator==(const AovKey&, const AovKey&) = default;
  };

  static HistogramTask::Input input_of_image(const AppState& state) {
    const auto& frame = state.viewport.frame;
    const auto& display = state.document().display;
    if (!frame) return {};
    return {.pixels = frame->pixels, .width = frame->width, .exposure = display.exposure, .curve = display.curve};
  }

  // Colours of an AOV are shown as they are, radiance like the image.
  HistogramTask::Input input_of_aov(const AppState& state) {
    const AovImage& image = state.viewport.aov->image();
    const AovKey key{image.name, image.version, image.samples};
    if (!aov_pixels_ || key != aov_key_) {
      aov_pixels_ = std::make_shared<const std::vector<Rgb>>(image.pixels);
      aov_key_ = key;
    }
    HistogramTask::Input input{.pixels = aov_pixels_, .width = image.width};
    if (!image.is_radiance) return input;
    input.exposure = state.document().display.exposure;
    input.curve = state.document().display.curve;
    return input;
  }

  std::string source_ = kBeauty;  // name of the AOV, or that of the image
  std::shared_ptr<const std::vector<Rgb>> aov_pixels_;  // of `aov_key_`
  AovKey aov_key_;
  HistogramTask task_;
};

}  // namespace

std::unique_ptr<Panel> make_histogram_panel() { return std::make_unique<HistogramPanel>(); }

}  // namespace etendue::viewer
