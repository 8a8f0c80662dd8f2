#include "viewer/widgets/chart_painter.h"

#include <algorithm>
#include <cmath>

#include "spectrum/rgb.h"

namespace etendue::viewer {
namespace {

using metrics::Point;

bool finite(const Point& s) { return std::isfinite(s.x) && std::isfinite(s.y); }
bool finite(const std::vector<Point>& spots) {
  return !spots.empty() && std::ranges::all_of(spots, [](const Point& s) { return finite(s); });
}

// An edge of an area that crosses a vertical strip: its y coordinates at the left and right sides of the strip.
struct Crossing {
  double left = 0;
  double right = 0;
};

std::vector<Crossing> crossings(const std::vector<Point>& points, double left, double right) {
  std::vector<Crossing> list;
  for (size_t i = 0; i < points.size(); ++i) {
    const Point& a = points[i];
    const Point& b = points[(i + 1) % points.size()];
    if (std::min(a.x, b.x) > left || std::max(a.x, b.x) < right) continue;
    const auto y_at = [&](double x) { return a.y + (x - a.x) / (b.x - a.x) * (b.y - a.y); };
    list.push_back({.left = y_at(left), .right = y_at(right)});
  }
  std::ranges::sort(list, {}, [](const Crossing& c) { return c.left + c.right; });
  return list;
}

class Painter {
 public:
  Painter(const UiContext& ui, ImDrawList& list, const ImVec2& corner)
      : list_(list), corner_(corner), scale_(ui.scale), font_(ui.fonts.small), theme_(ui.theme) {}

  // Dear ImGui fills only convex polygons, so an area is divided into vertical strips at the x coordinates of its
  // corners. Anti-aliasing is off because it would make the borders between strips visible.
  void operator()(const metrics::Polygon& area) {
    if (!finite(area.points)) return;
    std::vector<double> xs;
    for (const Point& s : area.points) xs.push_back(s.x);
    std::ranges::sort(xs);
    const ImDrawListFlags flags = list_.Flags;
    list_.Flags &= ~ImDrawListFlags_AntiAliasedFill;
    for (size_t i = 1; i < xs.size(); ++i) {
      if (xs[i] <= xs[i - 1]) continue;
      const auto edges = crossings(area.points, xs[i - 1], xs[i]);
      for (size_t k = 0; k + 1 < edges.size(); k += 2)
        list_.AddQuadFilled(at({xs[i - 1], edges[k].left}), at({xs[i], edges[k].right}),
                            at({xs[i], edges[k + 1].right}), at({xs[i - 1], edges[k + 1].left}), color_of(area.color));
    }
    list_.Flags = flags;
  }

  void operator()(const metrics::Polyline& stroke) {
    if (!finite(stroke.points)) return;
    const float width = static_cast<float>(stroke.width) * scale_;
    if (stroke.dashed) {
      for (const auto& [a, b] : metrics::dash_segments(stroke))
        list_.AddLine(at(a), at(b), color_of(stroke.color), width);
      return;
    }
    // A thin horizontal or vertical line is aligned to whole pixels.
    const Point& first = stroke.points.front();
    const Point& last = stroke.points.back();
    if (stroke.points.size() == 2 && stroke.width <= 1 && (first.x == last.x || first.y == last.y))
      return draw_aligned(first, last, color_of(stroke.color), width);
    for (const Point& s : stroke.points) list_.PathLineTo(at(s));
    list_.PathStroke(color_of(stroke.color), 0, width);
  }

  void operator()(const metrics::Dot& dot) {
    if (finite(dot.at)) list_.AddCircleFilled(at(dot.at), static_cast<float>(dot.radius) * scale_, color_of(dot.color));
  }

  void operator()(const metrics::Text& words) {
    if (!finite(words.at)) return;
    ImVec2 place = at(words.at);
    const float width = font_->CalcTextSizeA(font_->FontSize, 1e6f, 0, words.text.c_str()).x;
    if (words.anchor != metrics::Anchor::left) place.x -= words.anchor == metrics::Anchor::right ? width : width / 2;
    list_.AddText(font_, font_->FontSize, {std::floor(place.x), std::floor(place.y - font_->Ascent)},
                  ImGui::GetColorU32(text_color(words.color, theme_)), words.text.c_str());
  }

 private:
  ImVec2 at(const Point& s) const {
    return {corner_.x + static_cast<float>(s.x) * scale_, corner_.y + static_cast<float>(s.y) * scale_};
  }

  void draw_aligned(const Point& from, const Point& to, ImU32 color, float width) {
    const ImVec2 a = at(from);
    const ImVec2 b = at(to);
    if (from.x == to.x)
      list_.AddRectFilled({std::floor(a.x), std::min(a.y, b.y)},
                          {std::floor(a.x) + std::max(1.0f, width), std::max(a.y, b.y)}, color);
    else
      list_.AddRectFilled({std::min(a.x, b.x), std::floor(a.y)},
                          {std::max(a.x, b.x), std::floor(a.y) + std::max(1.0f, width)}, color);
  }

  ImDrawList& list_;
  const ImVec2 corner_;
  const float scale_;
  ImFont* const font_;
  const Theme& theme_;
};

// Relative luminance of an sRGB colour.
double luminance(const ImVec4& color) {
  return static_cast<double>(
      etendue::luminance({srgb_to_linear(color.x), srgb_to_linear(color.y), srgb_to_linear(color.z)}));
}

double contrast(const ImVec4& a, const ImVec4& b) {
  const auto [dark, light] = std::minmax({luminance(a), luminance(b)});
  return (light + 0.05) / (dark + 0.05);
}

}  // namespace

ImVec4 text_color(const metrics::Color& color, const Theme& theme) {
  constexpr double kLeastContrast = 4.5;
  const ImVec4 original = ImGui::ColorConvertU32ToFloat4(color_of(color));
  if (contrast(original, theme.panel) >= kLeastContrast) return original;
  const auto mixed = [](float a, float b) { return 0.5f * (a + b); };
  return {mixed(original.x, theme.text.x), mixed(original.y, theme.text.y), mixed(original.z, theme.text.z),
          original.w};
}

void paint(const UiContext& ui, ImDrawList& list, const metrics::Drawing& drawing, const ImVec2& corner) {
  Painter painter(ui, list, corner);
  for (const auto& shape : drawing.shapes) std::visit(painter, shape);
}

ImU32 color_of(const metrics::Color& color) {
  return IM_COL32(color.r, color.g, color.b, static_cast<int>(std::lround(255 * color.opacity)));
}

metrics::Color chart_color(const ImVec4& color) {
  const auto byte_of = [](float v) { return static_cast<uint8_t>(std::lround(255 * v)); };
  return {byte_of(color.x), byte_of(color.y), byte_of(color.z), static_cast<double>(color.w)};
}

bool draw_chart(UiContext& ui, const std::string& name, const Vec2& size, const metrics::Drawing& drawing) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton(name.c_str(), {size.x, size.y});
  ui.items.add(name);
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->PushClipRect(corner, {corner.x + size.x, corner.y + size.y}, true);
  paint(ui, *list, drawing, corner);
  list->PopClipRect();
  return ImGui::IsItemActive();
}

metrics::ChartPalette chart_palette(const Theme& theme) {
  metrics::ChartPalette palette;
  palette.text = chart_color(theme.text);
  palette.secondary_text = chart_color(theme.secondary_text);
  palette.grid = palette.secondary_text;
  palette.grid.opacity = 0.7;
  palette.minor_grid = palette.secondary_text;
  palette.minor_grid.opacity = 0.25;
  return palette;
}

}  // namespace etendue::viewer
