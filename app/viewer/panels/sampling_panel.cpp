// The samples of one pixel: running mean, histogram, and the points of the sampler that they are computed from.
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <tuple>

#include "film/film.h"
#include "integrator/integrator.h"
#include "render/pixel_samples.h"
#include "sampling/sampler.h"
#include "viewer/actions/action.h"
#include "viewer/panels/drawn_dimensions_view.h"
#include "viewer/panels/panel.h"
#include "viewer/panels/sample_points_view.h"
#include "viewer/state/app_state.h"
#include "viewer/state/document_info.h"
#include "viewer/tasks/pixel_samples_task.h"
#include "viewer/tasks/point_playback.h"
#include "viewer/widgets/action_widgets.h"
#include "viewer/widgets/basic_widgets.h"
#include "viewer/widgets/filter_box.h"
#include "viewer/widgets/parameter_widgets.h"
#include "viewer/widgets/plot.h"
#include "viewer/widgets/value_text.h"

namespace etendue::viewer {
namespace {

constexpr const char* kPickSampledPixel = "sampling.pick";
constexpr const char* kPlayPoints = "sampling.play";
constexpr uint32_t kVertices = 8;  // path vertices whose random numbers can be shown

const std::vector<render::Dimension>& sampler_dimensions() {
  static const auto list = render::path_dimensions(kVertices);
  return list;
}

const render::Dimension& find_dimension(const std::string& name) {
  const auto& list = sampler_dimensions();
  const auto found = std::ranges::find(list, name, &render::Dimension::name);
  return found == list.end() ? list.front() : *found;
}

constexpr const char* kNoSampler = "none";

// What the panel shows.
struct Settings {
  Number<int> samples{"sampling.samples",
                      "Samples",
                      4096,
                      {64, 65536},
                      "Number of samples that are drawn for this pixel, beside the main rendering",
                      "",
                      Scale::logarithmic};
  std::string x = "pixel-x";  // names of sampler dimensions
  std::string y = "pixel-y";
  Number<int> points{
      "sampling.points",
      "Points",
      512,
      {1, 4096},
      "Number of points: those of the first samples, in their order. The colours are the two half-buffers",
      "",
      Scale::logarithmic};
  Choice<IntervalShape> intervals{"sampling.intervals", "Elementary intervals", IntervalShape::square,
                                  "Shape of the intervals of equal area. A net has as many points in each"};
  std::string compared = kNoSampler;  // a second sampler

  friend bool operator==(const Settings& a, const Settings& b) {
    return a.samples.value == b.samples.value && a.x == b.x && a.y == b.y && a.points.value == b.points.value &&
           a.compared == b.compared;
  }
};

ParameterInfo dimension_parameter(const char* name, const char* label, const char* doc, const std::string& value) {
  ParameterInfo info;
  info.name = name;
  info.label = label;
  info.doc = doc;
  info.type = ParameterType::choice;
  info.default_value = value;
  for (const auto& dimension : sampler_dimensions()) {
    info.options.push_back(dimension.name);
    info.option_labels.push_back(dimension.label);
  }
  return info;
}

ParameterInfo compared_sampler_parameter(const std::string& value) {
  ParameterInfo info;
  info.name = "sampling.compare";
  info.label = "Compare with";
  info.doc = "A second sampler, with default settings, whose points are shown beside those of the rendering";
  info.type = ParameterType::choice;
  info.default_value = value;
  info.options = {kNoSampler};
  info.option_labels = {"None"};
  for (const auto& sampler : sampler_infos()) {
    info.options.push_back(sampler.name);
    info.option_labels.push_back(sampler.label);
  }
  return info;
}

std::vector<ParameterInfo> describe_settings(const Settings& settings) {
  return {
      describe(settings.samples),
      dimension_parameter("sampling.x", "Horizontal axis", "The sample dimension on the horizontal axis", settings.x),
      dimension_parameter("sampling.y", "Vertical axis", "The sample dimension on the vertical axis", settings.y),
      describe(settings.points),
      describe(settings.intervals),
      compared_sampler_parameter(settings.compared)};
}

// The integrators whose samples belong to single pixels.
std::string per_pixel_integrators() {
  std::string names;
  for (const auto& info : integrator::integrator_infos())
    if (info.accumulation == integrator::Accumulation::per_pixel) names += (names.empty() ? "" : ", ") + info.label;
  return names;
}

// Numbers in one line, or in several lines if the panel is narrow.
class ValueLine {
 public:
  explicit ValueLine(const UiContext& ui) : ui_(ui) {}

  void add(const char* label, const std::string& value, const char* tooltip_text, bool is_warning = false) {
    const float em = ImGui::GetFontSize();
    ImFont* font = ui_.fonts.monospace;
    const float value_width = font->CalcTextSizeA(font->FontSize, 1e6f, 0, value.c_str()).x;
    const float width = ImGui::CalcTextSize(label).x + em * 0.4f + value_width;
    if (!first_) {
      ImGui::SameLine(0, em * 0.9f);
      if (ImGui::GetCursorPosX() + width > end_) ImGui::NewLine();
    }
    first_ = false;
    ImGui::TextDisabled("%s", label);
    ImGui::SameLine(0, em * 0.4f);
    ImGui::PushFont(font);
    const ImVec4 color = is_warning ? ui_.theme.warning : ui_.theme.text;
    ImGui::TextColored(color, "%s", value.c_str());
    ImGui::PopFont();
    if (ImGui::IsItemHovered()) tooltip(ui_, tooltip_text);
  }

 private:
  const UiContext& ui_;
  const float end_ = ImGui::GetContentRegionMax().x;
  bool first_ = true;
};

void draw_values(const UiContext& ui, const PixelStatistics& s) {
  const auto& last = s.running_mean.back();
  const bool incomplete = s.samples() < s.target_samples;
  ValueLine line(ui);
  line.add("n", incomplete ? formatted("%u of %u", s.samples(), s.target_samples) : formatted("%u", s.samples()),
           "Number of samples");
  line.add("mean", formatted("%.4g \u00b1 %.2g", last.mean, last.confidence),
           "Mean luminance with its 95 % confidence interval, cd/m\u00b2");
  line.add("std. dev.", formatted("%.3g", s.standard_deviation), "Standard deviation of one sample");
  line.add("max", formatted("%.3g", s.maximum), "Luminance of the brightest sample");
  line.add("zero", formatted("%.3g %%", 100 * s.histogram.zeros / static_cast<double>(s.samples())),
           "Share of samples that found no light");
  line.add("tail index", s.tail.khat ? formatted("%.2f", *s.tail.khat) : "-",
           "Pareto shape k of the largest samples. From 0.5 on the variance is infinite; above 0.7 mean and error are "
           "unreliable",
           s.tail.heavy());
}

PlotAxis mean_axis(const PixelStatistics& s) {
  constexpr uint32_t kFirstShown = 16;  // earlier means vary so much that they would dominate the axis
  const auto& means = s.running_mean;
  auto first = std::ranges::find_if(means, [](const auto& e) { return e.samples >= kFirstShown; });
  if (first == means.end()) first = means.end() - 1;
  double low = INFINITY;
  double high = -INFINITY;
  for (auto e = first; e != means.end(); ++e) {
    low = std::min({low, e->mean - e->confidence, e->half_means[0], e->half_means[1]});
    high = std::max({high, e->mean + e->confidence, e->half_means[0], e->half_means[1]});
  }
  low = std::max(low, 0.0);
  const double margin = high > low ? 0.05 * (high - low) : std::max(1e-6, 0.1 * std::abs(high));
  return {.logarithmic = false, .low = std::max(0.0, low - margin), .high = high + margin};
}

void draw_running_mean(const UiContext& ui, ImDrawList* draw, const Placement& frame, const PixelStatistics& s) {
  const PlotAxis samples_axis{.logarithmic = true, .low = 2, .high = static_cast<double>(s.target_samples)};
  const Plot plot(ui, draw, frame, "Running mean", samples_axis, mean_axis(s));
  plot.draw_axes();
  const Vec2 corner = plot.area().corner;
  const Vec2 end = corner + plot.area().size;
  draw->PushClipRect({corner.x, corner.y}, {end.x, end.y}, true);
  // Anti-aliased edges of the narrow quads would be visible within the confidence band.
  draw->Flags &= ~ImDrawListFlags_AntiAliasedFill;
  const ImU32 band_color = ImGui::GetColorU32(ImGuiCol_Text, 0.16f);
  std::vector<ImVec2> mean;
  std::vector<ImVec2> halves[2];
  for (size_t i = 0; i < s.running_mean.size(); ++i) {
    const auto& e = s.running_mean[i];
    mean.push_back(plot.at(e.samples, e.mean));
    for (size_t h = 0; h < 2; ++h) halves[h].push_back(plot.at(e.samples, e.half_means[h]));
    if (i == 0) continue;
    const auto& p = s.running_mean[i - 1];
    draw->AddQuadFilled(plot.at(p.samples, p.mean - p.confidence), plot.at(e.samples, e.mean - e.confidence),
                        plot.at(e.samples, e.mean + e.confidence), plot.at(p.samples, p.mean + p.confidence),
                        band_color);
  }
  draw->Flags |= ImDrawListFlags_AntiAliasedFill;
  for (int h = 0; h < 2; ++h) plot.draw_curve(halves[h], half_buffer_color(ui, h), 1.3f);
  plot.draw_curve(mean, ImGui::GetColorU32(ImGuiCol_Text), 2);
  draw->PopClipRect();
}

void draw_histogram(const UiContext& ui, ImDrawList* draw, const Placement& frame, const PixelStatistics& s) {
  const Histogram& h = s.histogram;
  const float em = ImGui::GetFontSize();
  const uint32_t max_count = std::max(h.zeros, h.counts.empty() ? 0u : *std::ranges::max_element(h.counts));
  // Zeros have a bar of their own to the left of the axis.
  const float zeros_width = h.zeros > 0 ? em * 2 : 0;
  const Placement plot_frame{frame.corner + Vec2(zeros_width, 0), frame.size - Vec2(zeros_width, 0)};
  const PlotAxis luminance_axis{.logarithmic = h.logarithmic, .low = h.low, .high = h.high};
  const PlotAxis count_axis{.logarithmic = true, .low = 0.7, .high = std::max(10.0, 1.5 * max_count)};
  const Plot plot(ui, draw, plot_frame, h.logarithmic ? "Luminance (log)" : "Luminance", luminance_axis, count_axis);
  plot.draw_axes();
  const Vec2 corner = plot.area().corner;
  const Vec2 size = plot.area().size;
  const float bottom = corner.y + size.y;
  const float bin_width = size.x / static_cast<float>(std::max<size_t>(1, h.counts.size()));
  for (size_t i = 0; i < h.counts.size(); ++i) {
    if (h.counts[i] == 0) continue;
    const float x = corner.x + bin_width * static_cast<float>(i);
    draw->AddRectFilled({x + 0.5f, plot.at(h.low, h.counts[i]).y}, {x + bin_width - 0.5f, bottom},
                        ImGui::GetColorU32(ui.theme.accent));
  }
  if (s.maximum > 0) {
    const ImU32 text = ImGui::GetColorU32(ImGuiCol_Text);
    const float x = corner.x + size.x;
    const float y = plot.at(h.high, h.counts.back()).y - em * 0.6f;
    draw->AddTriangleFilled({x - em * 0.3f, y}, {x + em * 0.3f, y}, {x, y + em * 0.5f}, text);
    plot.draw_text({x - em * 0.3f, corner.y + em * 0.7f}, 1, text, formatted("max %.3g", s.maximum).c_str());
  }
  if (h.zeros == 0) return;
  const ImU32 color = ImGui::GetColorU32(ui.theme.secondary_text);
  const float x = frame.corner.x + em * 0.7f;
  draw->AddRectFilled({x, plot.at(h.high, h.zeros).y}, {x + em * 0.8f, bottom}, color);
  plot.draw_text({x + em * 0.4f, bottom + em * 0.75f}, 0.5f, color, "0");
}

class SamplingPanel final : public Panel {
 public:
  PanelInfo info() const override {
    return {.name = "panel.sampling",
            .label = "Sampling",
            .description = "Samples of one pixel: running mean, histogram, and the sample points of the sampler",
            .place = PanelPlace::bottom};
  }

  void draw(AppState& state) override {
    const float em = ImGui::GetFontSize();
    const ImVec2 available = ImGui::GetContentRegionAvail();
    if (available.x >= 50 * em) {
      ImGui::BeginChild("##controls", {em * 19.5f, 0});
      draw_controls(state);
      ImGui::EndChild();
      ImGui::SameLine(0, em);
      ImGui::BeginChild("##charts");
      draw_charts(state);
      ImGui::EndChild();
      return;
    }
    // In a narrow panel the charts are above the controls, except before a pixel is selected.
    if (!task_.pixel()) draw_controls(state);
    ImGui::BeginChild("##charts", {0, std::max(available.y, 10 * em)});
    draw_charts(state);
    ImGui::EndChild();
    if (task_.pixel()) draw_controls(state);
  }

  std::vector<ParameterInfo> parameters() const override { return describe_settings({}); }

  void add_actions(ActionList& actions) override {
    const auto use = [this](AppState& state, Vec2 position) {
      select_pixel(state, position);
      return true;
    };
    actions.add({.name = kPickSampledPixel,
                 .menu = "View",
                 .label = "Pick pixel",
                 .tooltip = "Shows the samples of the pixel where you click next",
                 .run =
                     [this, use](AppState& state) {
                       state.toggle_tool({.name = kPickSampledPixel, .use = use});
                       state.panels.open(*this);
                     },
                 .enabled = [](const AppState& state) { return state.has_document(); },
                 .checked = [](const AppState& state) { return state.is_active_tool(kPickSampledPixel); }});
    actions.add({.name = kPlayPoints,
                 .menu = "View",
                 .label = "Play points",
                 .tooltip = "Shows the sample points of the selected pixel one by one, first slowly. Without a pixel: "
                            "click one first",
                 .run =
                     [this, use](AppState& state) {
                       if (task_.pixel())
                         playback_.toggle();
                       else if (!state.is_active_tool(kPickSampledPixel))
                         state.toggle_tool({.name = kPickSampledPixel, .use = use});
                       state.panels.open(*this);
                     },
                 .enabled = [](const AppState& state) { return state.has_document(); },
                 .checked = [this](const AppState&) { return playback_.is_playing(); }});
  }

  std::vector<WaitCondition> wait_conditions() override {
    const auto check = [this](AppState& state, std::optional<uint32_t>) -> StepStatus {
      if (!render::PixelSamples::supports(state.document()))
        return {.error = "no sample of this integrator belongs to one pixel"};
      if (!task_.pixel()) return {.error = "no pixel is selected; click sampling.pick and then the image first"};
      return {.done = !task_.is_incomplete()};
    };
    return {{.name = "pixel", .check = check, .needs_frames = true}};
  }

  void report(AppState&, nlohmann::json& json) override {
    const auto statistics = task_.result();
    if (!statistics) return;
    const PixelStatistics& s = *statistics;
    auto& pixel = json["pixel"];
    pixel = {{"x", s.pixel.x},
             {"y", s.pixel.y},
             {"samples", s.samples()},
             {"wanted", s.target_samples},
             {"mean", {s.mean.r, s.mean.g, s.mean.b}},
             {"deviation", s.standard_deviation},
             {"largest", s.maximum},
             {"zeros", s.histogram.zeros}};
    if (!s.running_mean.empty()) {
      pixel["luminance"] = s.running_mean.back().mean;
      pixel["band"] = s.running_mean.back().confidence;
    }
    if (s.tail.khat) pixel["khat"] = *s.tail.khat;
    pixel["points"] = shown_points_;
    pixel["points_play"] = playback_.is_playing();
    auto& drawn = pixel["drawn_dimensions"];
    for (const auto& dimension : sampler_dimensions())
      if (const uint32_t count = s.drawn_dimensions.at(dimension.block, dimension.index))
        drawn[dimension.name] = count / static_cast<double>(s.counted_samples);
  }

  void update(AppState& state) override {
    if (state.panels.is_open(*this))
      task_.update(state.task_context, static_cast<uint32_t>(settings_.samples.value));
    else
      task_.pause();
  }

  std::vector<Task*> tasks() override { return {&task_, &playback_}; }

  // Ctrl+click selects a pixel.
  bool handle_click(AppState& state, Vec2 position) override {
    if (!state.ui.input.control()) return false;
    select_pixel(state, position);
    return true;
  }

  // A frame with crosshairs around the selected pixel.
  void draw_overlay(AppState& state, ImDrawList& draw) override {
    if (!task_.pixel() || !state.is_visible(*this)) return;
    const Placement& image = state.viewport.image;
    const Vec2 pixel_size = image.size / Vec2(state.document().width, state.document().height);
    const Vec2 centre = image.corner + (Vec2(*task_.pixel()) + 0.5f) * pixel_size;
    const float half = std::max(0.5f * pixel_size.x + 1, ImGui::GetFontSize() * 0.35f);
    const auto draw_marker = [&](ImU32 color, float width) {
      draw.AddRect({centre.x - half, centre.y - half}, {centre.x + half, centre.y + half}, color, 0, 0, width);
      for (const Vec2& direction : {Vec2(1, 0), Vec2(-1, 0), Vec2(0, 1), Vec2(0, -1)}) {
        const Vec2 from = centre + direction * half;
        const Vec2 to = centre + direction * half * 2.4f;
        draw.AddLine({from.x, from.y}, {to.x, to.y}, color, width);
      }
    };
    draw_marker(IM_COL32(0, 0, 0, 170), 3.5f);
    draw_marker(IM_COL32(255, 220, 80, 255), 1.5f);
  }

 private:
  // The sample points and what they depend on.
  struct PointCache {
    render::MethodSettings method;
    uint64_t seed = 0;
    Vec2i pixel{-1};
    Settings settings;
    std::vector<Vec2> points = {}, compared_points = {};
  };

  void select_pixel(AppState& state, Vec2 position) {
    const auto& d = state.document();
    task_.set_pixel(pixel_at(state.viewport.image, {d.width, d.height}, position));
    state.panels.open(*this);
  }

  void draw_controls(AppState& state) {
    action_button(state, kPickSampledPixel);
    if (const auto& pixel = task_.pixel()) {
      ImGui::SameLine();
      ImGui::PushFont(state.ui.fonts.monospace);
      ImGui::Text("%d, %d", pixel->x, pixel->y);
      ImGui::PopFont();
      action_button(state, kPlayPoints);
    }
    filtered_parameters(state, [&] { draw_parameters(state); });
    const auto statistics = task_.result();
    if (!statistics || statistics->counted_samples == 0) return;
    if (!group(state.ui, "Dimensions in use", "sampling.dimensions")) return;
    if (const auto chosen = drawn_dimensions_table(state.ui, *statistics, kVertices))
      std::tie(settings_.x, settings_.y) = *chosen;
  }

  void draw_parameters(AppState& state) {
    const auto infos = describe_settings(settings_);
    if (const auto value = parameter_widget(state, infos[0])) assign(settings_.samples, *value);
    if (const auto value = parameter_widget(state, infos[1])) settings_.x = std::get<std::string>(*value);
    if (const auto value = parameter_widget(state, infos[2])) settings_.y = std::get<std::string>(*value);
    if (const auto value = parameter_widget(state, infos[3])) assign(settings_.points, *value);
    if (const auto value = parameter_widget(state, infos[4])) assign(settings_.intervals, *value);
    if (const auto value = parameter_widget(state, infos[5])) settings_.compared = std::get<std::string>(*value);
  }

  void draw_charts(AppState& state) {
    const UiContext& ui = state.ui;
    if (!render::PixelSamples::supports(state.document()))
      return warning(ui, "The samples of " + integrator_label(state.document().method.integrator) +
                             " do not belong to single pixels, because its paths contribute to any pixel. Integrators "
                             "with samples per pixel: " +
                             per_pixel_integrators() + ".");
    if (!task_.pixel()) return note(ui, "Select a pixel with Pick pixel and a click in the image, or with Ctrl+click.");
    const auto statistics = task_.result();
    if (!statistics || statistics->running_mean.empty()) return note(ui, "Drawing the first samples.");
    draw_values(ui, *statistics);
    ImDrawList* draw = ImGui::GetWindowDrawList();
    const ImVec2 screen_corner = ImGui::GetCursorScreenPos();
    const ImVec2 available = ImGui::GetContentRegionAvail();
    const float em = ImGui::GetFontSize();
    const int squares = settings_.compared == kNoSampler ? 1 : 2;
    const float square = std::min(available.y - em * 0.2f, available.x * 0.27f);
    const float rest = available.x - static_cast<float>(squares) * (square + em);
    // The histogram gives way to the second square if both charts would be too narrow for their labels.
    const bool has_histogram = squares == 1 || rest >= 24 * em;
    const float width = std::max(1.0f, has_histogram ? rest * 0.5f : rest);
    const Vec2 corner(screen_corner.x, screen_corner.y);
    draw_running_mean(ui, draw, {corner, {width, available.y}}, *statistics);
    if (has_histogram) draw_histogram(ui, draw, {corner + Vec2(width, 0), {width, available.y}}, *statistics);
    const PointCache& points = sample_points(state, statistics->pixel);
    Placement frame{corner + Vec2((has_histogram ? 2 : 1) * width + em, 0), {square, square}};
    shown_points_ = playback_.shown(static_cast<uint32_t>(points.points.size()));
    const auto draw_points = [&](const std::string& sampler, const std::vector<Vec2>& list) {
      const std::string count = playback_.is_playing() ? formatted(" (%u points)", shown_points_) : "";
      draw_sample_points(ui, draw, frame, sampler_label(sampler) + count, std::span(list).first(shown_points_),
                         settings_.intervals.value);
      frame.corner.x += square + em;
    };
    draw_points(state.document().method.sampler, points.points);
    if (squares == 2) draw_points(settings_.compared, points.compared_points);
  }

  static std::string sampler_label(const std::string& name) {
    const SamplerInfo* info = find_sampler(name);
    return info ? info->label : name;
  }

  const PointCache& sample_points(const AppState& state, Vec2i pixel) {
    const auto& d = state.document();
    const bool is_current =
        cache_.method == d.method && cache_.seed == d.seed && cache_.pixel == pixel && cache_.settings == settings_;
    if (is_current) return cache_;
    const auto points_of = [&](const render::Document& document) {
      return render::sample_points(document, pixel, find_dimension(settings_.x), find_dimension(settings_.y),
                                   static_cast<uint32_t>(settings_.points.value));
    };
    cache_ = {.method = d.method, .seed = d.seed, .pixel = pixel, .settings = settings_, .points = points_of(d)};
    if (settings_.compared != kNoSampler) {
      render::Document other = d;
      other.method.sampler = settings_.compared;
      other.method.settings.clear();
      cache_.compared_points = points_of(other);
    }
    return cache_;
  }

  Settings settings_;
  PixelSamplesTask task_;
  PointPlayback playback_;
  uint32_t shown_points_ = 0;
  PointCache cache_;
};

}  // namespace

std::unique_ptr<Panel> make_sampling_panel() { return std::make_unique<SamplingPanel>(); }

}  // namespace etendue::viewer
