// What do the samples of one pixel look like, and which points were they made of?
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "integrator/integrator.h"
#include "viewer/layout/bottom_panel.h"
#include "viewer/widgets/format.h"
#include "viewer/widgets/parameter_widgets.h"
#include "viewer/widgets/plot.h"

namespace etendue::viewer {
namespace {

constexpr uint32_t kVertices = 4;  // whose random numbers can be looked at

const std::vector<render::Dimension>& known_dimensions() {
  static const auto list = render::path_dimensions(kVertices);
  return list;
}

const render::Dimension& dimension(const std::string& name) {
  const auto& list = known_dimensions();
  const auto at = std::ranges::find(list, name, &render::Dimension::name);
  return at == list.end() ? list.front() : *at;
}

// Points are few and made at once, but not in every frame.
const std::vector<Vec2>& points_of(const Workbench& w, Vec2i pixel) {
  struct Key {
    render::MethodSettings method;
    uint64_t seed = 0;
    Vec2i pixel{-1};
    SamplingView view;
    bool operator==(const Key&) const = default;
  };
  static Key made;
  static std::vector<Vec2> points;
  const auto& d = w.editor.document();
  const Key key{d.method, d.seed, pixel, w.view.sampling};
  if (!(key == made)) {
    points = render::sample_points(d, pixel, dimension(key.view.x), dimension(key.view.y), key.view.points);
    made = key;
  }
  return points;
}

void controls(Workbench& w) {
  SamplingView& view = w.view.sampling;
  action_button(w, "sampling.pick");
  if (w.probe.pixel()) {
    ImGui::SameLine();
    ImGui::PushFont(w.faces.figures);
    ImGui::Text("%d, %d", w.probe.pixel()->x, w.probe.pixel()->y);
    ImGui::PopFont();
  }
  for (ParameterInfo& info : sampling_parameters()) {
    if (info.name == "sampling.samples") info.default_value = int64_t{view.samples};
    if (info.name == "sampling.x") info.default_value = view.x;
    if (info.name == "sampling.y") info.default_value = view.y;
    if (info.name == "sampling.points") info.default_value = std::to_string(view.points);
    const auto value = loose_widget(w, info);
    if (!value) continue;
    if (info.name == "sampling.samples") view.samples = static_cast<uint32_t>(std::get<int64_t>(*value));
    if (info.name == "sampling.x") view.x = std::get<std::string>(*value);
    if (info.name == "sampling.y") view.y = std::get<std::string>(*value);
    if (info.name == "sampling.points") view.points = static_cast<uint32_t>(std::stoul(std::get<std::string>(*value)));
  }
}

// All figures in a line, or in more where that is too narrow.
void figures(Workbench& w, const PixelStudy& s) {
  const double n = s.samples();
  const float gap = ImGui::GetFontSize() * 0.9f, end = ImGui::GetContentRegionMax().x;
  bool first = true;
  const auto part = [&](const char* label, const std::string& value, const char* doc, bool warns = false) {
    const float width = ImGui::CalcTextSize(label).x + ImGui::GetFontSize() * 0.4f +
                        w.faces.figures->CalcTextSizeA(w.faces.figures->FontSize, 1e6f, 0, value.c_str()).x;
    if (!first) ImGui::SameLine(0, gap);
    if (!first && ImGui::GetCursorPosX() + width > end) ImGui::NewLine();
    first = false;
    ImGui::TextDisabled("%s", label);
    ImGui::SameLine(0, ImGui::GetFontSize() * 0.4f);
    ImGui::PushFont(w.faces.figures);
    ImGui::TextColored(warns ? w.theme.warning : ImGui::GetStyleColorVec4(ImGuiCol_Text), "%s", value.c_str());
    ImGui::PopFont();
    if (ImGui::IsItemHovered()) tooltip(w, doc);
  };
  part("n", s.samples() < s.wanted ? text_of("%u of %u", s.samples(), s.wanted) : text_of("%u", s.samples()),
       "Samples drawn");
  part("mean", text_of("%.4g \u00b1 %.2g", s.course.back().mean, s.course.back().band),
       "Of the luminance, and how far the truth may be in 95 of 100 cases");
  part("sd", text_of("%.3g", s.deviation), "Of one sample");
  part("max", text_of("%.3g", s.largest), "The brightest sample");
  part("zeros", text_of("%.3g %%", 100 * s.histogram.zeros / n), "Samples that found no light at all");
  part("khat", s.tail.khat ? text_of("%.2f", *s.tail.khat) : "-",
       "Shape of the tail of large samples: from 0.5 on their variance is infinite, above 0.7 mean and error cannot be "
       "relied on",
       s.tail.heavy());
}

void running_mean(Workbench& w, ImDrawList* draw, const Placement& frame, const PixelStudy& s) {
  // The first handful would stretch the axis over everything that comes later.
  const size_t settled =
      std::min(s.course.size() - 1,
               static_cast<size_t>(std::ranges::find_if(s.course, [](const auto& m) { return m.samples >= 16; }) -
                                   s.course.begin()));
  double low = INFINITY, high = -INFINITY;
  for (size_t i = settled; i < s.course.size(); ++i) {
    const auto& m = s.course[i];
    low = std::min({low, m.mean - m.band, m.halves[0], m.halves[1]}),
    high = std::max({high, m.mean + m.band, m.halves[0], m.halves[1]});
  }
  low = std::max(low, 0.0);
  const double margin = high > low ? 0.05 * (high - low) : std::max(1e-6, 0.1 * std::abs(high));
  const Plot plot(w, draw, frame, "Running mean", {true, 2, static_cast<double>(s.wanted)},
                  {false, std::max(0.0, low - margin), high + margin});
  plot.draw_axes();
  const Vec2 corner = plot.inner().corner, end = corner + plot.inner().size;
  draw->PushClipRect({corner.x, corner.y}, {end.x, end.y}, true);
  // Smoothed edges of so narrow pieces would stand out of the band.
  draw->Flags &= ~ImDrawListFlags_AntiAliasedFill;
  const ImU32 band = ImGui::GetColorU32(ImGuiCol_Text, 0.16f);
  std::vector<ImVec2> mean, halves[2];
  for (size_t i = 0; i < s.course.size(); ++i) {
    const auto& m = s.course[i];
    mean.push_back(plot.at(m.samples, m.mean));
    for (size_t h = 0; h < 2; ++h) halves[h].push_back(plot.at(m.samples, m.halves[h]));
    if (i == 0) continue;
    const auto& b = s.course[i - 1];
    draw->AddQuadFilled(plot.at(b.samples, b.mean - b.band), plot.at(m.samples, m.mean - m.band),
                        plot.at(m.samples, m.mean + m.band), plot.at(b.samples, b.mean + b.band), band);
  }
  draw->Flags |= ImDrawListFlags_AntiAliasedFill;
  for (int h = 0; h < 2; ++h) plot.curve(halves[h], half_color(w, h), 1.3f);
  plot.curve(mean, ImGui::GetColorU32(ImGuiCol_Text), 2);
  draw->PopClipRect();
}

void histogram(Workbench& w, ImDrawList* draw, const Placement& frame, const PixelStudy& s) {
  const Histogram& h = s.histogram;
  const uint32_t most = std::max(h.zeros, h.counts.empty() ? 0u : *std::ranges::max_element(h.counts));
  // Zeros have a place of their own on the left.
  const float apart = h.zeros > 0 ? ImGui::GetFontSize() * 2 : 0;
  const PlotAxis counts{true, 0.7, std::max(10.0, 1.5 * most)};
  const Placement right{frame.corner + Vec2(apart, 0), frame.size - Vec2(apart, 0)};
  const Plot plot(w, draw, right, h.logarithmic ? "Luminance (log)" : "Luminance", {h.logarithmic, h.low, h.high},
                  counts);
  plot.draw_axes();
  const ImU32 fill = ImGui::GetColorU32(w.theme.accent);
  const Vec2 corner = plot.inner().corner, size = plot.inner().size;
  const float floor = corner.y + size.y;
  for (size_t i = 0; i < h.counts.size(); ++i) {
    if (h.counts[i] == 0) continue;
    const float step = size.x / static_cast<float>(h.counts.size()), x = corner.x + step * static_cast<float>(i);
    draw->AddRectFilled({x + 0.5f, plot.at(h.low, h.counts[i]).y}, {x + step - 0.5f, floor}, fill);
  }
  const ImU32 text = ImGui::GetColorU32(ImGuiCol_Text);
  const float em = ImGui::GetFontSize();
  if (s.largest > 0) {
    const float x = corner.x + size.x, y = plot.at(h.high, h.counts.back()).y - em * 0.6f;
    draw->AddTriangleFilled({x - em * 0.3f, y}, {x + em * 0.3f, y}, {x, y + em * 0.5f}, text);
    plot.words({x - em * 0.3f, corner.y + em * 0.7f}, 1, text, text_of("max %.3g", s.largest).c_str());
  }
  if (h.zeros == 0) return;
  const float x = frame.corner.x + em * 0.7f;
  draw->AddRectFilled({x, plot.at(h.high, h.zeros).y}, {x + em * 0.8f, floor}, ImGui::GetColorU32(w.theme.quiet));
  plot.words({x + em * 0.4f, floor + em * 0.75f}, 0.5f, ImGui::GetColorU32(w.theme.quiet), "0");
}

void points(Workbench& w, ImDrawList* draw, const Placement& frame, Vec2i pixel) {
  const SamplingView& view = w.view.sampling;
  const float em = ImGui::GetFontSize(), side = std::floor(frame.size.y - em * 1.7f);
  const Vec2 corner = frame.corner + Vec2(0, em * 1.5f);
  draw->AddText({frame.corner.x, frame.corner.y}, half_color(w, 0), "Half 1");
  draw->AddText({frame.corner.x + em * 3.4f, frame.corner.y}, half_color(w, 1), "Half 2");
  draw->AddRectFilled({corner.x, corner.y}, {corner.x + side, corner.y + side},
                      ImGui::GetColorU32(ImGuiCol_FrameBg, 0.4f));
  // Of a net, each half has as many points in each of these squares.
  int cells = 1;
  while (4 * cells * cells <= static_cast<int>(view.points / film::kHalves)) cells *= 2;
  const ImU32 line = ImGui::GetColorU32(ImGuiCol_Border, 0.8f);
  for (int i = 0; i <= cells; ++i) {
    const float at = side * static_cast<float>(i) / static_cast<float>(cells);
    draw->AddLine({corner.x + at, corner.y}, {corner.x + at, corner.y + side}, line);
    draw->AddLine({corner.x, corner.y + at}, {corner.x + side, corner.y + at}, line);
  }
  const float radius = em * (view.points > 1000 ? 0.07f : view.points > 200 ? 0.1f : 0.17f);
  const auto& list = points_of(w, pixel);
  for (size_t i = 0; i < list.size(); ++i)
    draw->AddCircleFilled({corner.x + side * list[i].x, corner.y + side * (1 - list[i].y)}, radius,
                          half_color(w, static_cast<int>(i % film::kHalves)), 8);
}

// The methods whose samples are made pixel by pixel, as the registry says.
std::string names_of_pixel_methods() {
  std::string names;
  for (const auto& info : integrator::integrator_infos())
    if (info.accumulation == integrator::Accumulation::per_pixel) names += (names.empty() ? "" : ", ") + info.name;
  return names;
}

void charts(Workbench& w) {
  if (!render::PixelSamples::possible(w.editor.document()))
    return warning(w, "No sample of " + w.editor.document().method.integrator +
                          " belongs to one pixel: its paths end on pixels that they did not choose, or wait for what "
                          "all pixels share. Pixels can be looked at with " +
                          names_of_pixel_methods() + ".");
  const auto study = w.probe.study();
  if (!w.probe.pixel())
    return note(w, "Choose a pixel: press Pick a pixel and click in the picture, or Ctrl+click there.");
  if (!study || study->course.empty()) return note(w, "The first samples are being drawn.");
  figures(w, *study);
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const ImVec2 from = ImGui::GetCursorScreenPos(), room = ImGui::GetContentRegionAvail();
  const float em = ImGui::GetFontSize(), square = std::min(room.y - em * 0.2f, room.x * 0.27f);
  const float wide = std::max(1.0f, (room.x - square - em) * 0.5f);
  const Vec2 corner(from.x, from.y);
  running_mean(w, draw, {corner, {wide, room.y}}, *study);
  histogram(w, draw, {corner + Vec2(wide, 0), {wide, room.y}}, *study);
  points(w, draw, {corner + Vec2(2 * wide + em, 0), {square, square}}, study->pixel);
}

}  // namespace

std::vector<ParameterInfo> sampling_parameters() {
  ParameterInfo samples;
  samples.name = "sampling.samples", samples.label = "Samples",
  samples.doc = "Drawn of the pixel, beside the rendering";
  samples.type = ParameterType::integer, samples.min = 64, samples.max = 65536, samples.logarithmic = true;
  samples.default_value = int64_t{SamplingView{}.samples};
  ParameterInfo x;
  x.name = "sampling.x", x.label = "Points across", x.doc = "What the points' first number decides";
  x.type = ParameterType::choice, x.default_value = SamplingView{}.x;
  for (const auto& d : known_dimensions()) x.options.push_back(d.name), x.option_labels.push_back(d.label);
  ParameterInfo y = x;
  y.name = "sampling.y", y.label = "Points up", y.doc = "What the points' second number decides",
  y.default_value = SamplingView{}.y;
  ParameterInfo count;
  count.name = "sampling.points", count.label = "Points",
  count.doc = "How many of the first samples' points are shown; one half of them in each colour";
  count.type = ParameterType::choice, count.default_value = std::to_string(SamplingView{}.points);
  count.options = count.option_labels = {"32", "128", "512", "2048"};
  return {samples, x, y, count};
}

void draw_sampling_sheet(Workbench& w) {
  const float em = ImGui::GetFontSize();
  const ImVec2 room = ImGui::GetContentRegionAvail();
  if (room.x < 50 * em) {
    // Side by side there would be no room for the charts: they come first, what is set below them.
    if (!w.probe.pixel()) controls(w);
    ImGui::BeginChild("##charts", {0, std::max(room.y, 10 * em)});
    charts(w);
    ImGui::EndChild();
    if (w.probe.pixel()) controls(w);
    return;
  }
  ImGui::BeginChild("##controls", {em * 19.5f, 0});
  controls(w);
  ImGui::EndChild();
  ImGui::SameLine(0, em);
  ImGui::BeginChild("##charts");
  charts(w);
  ImGui::EndChild();
}

void draw_pixel_marker(Workbench& w, ImDrawList* draw) {
  if (!w.probe.pixel() || w.view.sheet != "sheet.sampling" || !w.view.interface) return;
  const Vec2 size(w.editor.document().width, w.editor.document().height);
  const Placement& p = w.view.picture;
  const Vec2 middle = p.corner + (Vec2(*w.probe.pixel()) + 0.5f) * p.size / size;
  const float half = std::max(0.5f * p.size.x / size.x + 1, ImGui::GetFontSize() * 0.35f);
  for (const auto& [color, width] :
       {std::pair{IM_COL32(0, 0, 0, 170), 3.5f}, std::pair{IM_COL32(255, 220, 80, 255), 1.5f}}) {
    draw->AddRect({middle.x - half, middle.y - half}, {middle.x + half, middle.y + half}, color, 0, 0, width);
    for (const Vec2& way : {Vec2(1, 0), Vec2(-1, 0), Vec2(0, 1), Vec2(0, -1)}) {
      const Vec2 from = middle + way * half, to = middle + way * half * 2.4f;
      draw->AddLine({from.x, from.y}, {to.x, to.y}, color, width);
    }
  }
}

}  // namespace etendue::viewer
