#include <algorithm>
#include <cmath>

#include "bsdf_analysis/drawings.h"
#include "spectrum/colormap.h"

namespace etendue::bsdf_analysis {
namespace {

using metrics::Color;
using metrics::Drawing;
using metrics::Point;

struct Patch {
  std::vector<Point> corners;
  double depth;  // larger is closer to the viewer
  Color color;
};

// Orthographic projection from the viewpoint of the options.
class View {
 public:
  View(const DrawingOptions& options, bool below) : options_(options) {
    constexpr double kRadians = 3.14159265358979323846 / 180;
    cos_azimuth_ = std::cos(options.azimuth * kRadians);
    sin_azimuth_ = std::sin(options.azimuth * kRadians);
    cos_elevation_ = std::cos(options.elevation * kRadians);
    sin_elevation_ = std::sin(options.elevation * kRadians);
    // Leaves space for the label of the normal above, and for the disk or the lower side below.
    const double up = 1.2, down = below ? 1.1 : std::abs(sin_elevation_) + 0.05;
    scale_ = std::min(options.width / 2.1, options.height / (up + down));
    center_ = {0.5 * options.width, up * scale_ + 0.5 * (options.height - (up + down) * scale_)};
  }

  Point at(const Vec3& p) const {
    const Vec3 q = to_view(p);
    return {center_.x + scale_ * static_cast<double>(q.x), center_.y - scale_ * static_cast<double>(q.y)};
  }
  double depth(const Vec3& p) const { return static_cast<double>(to_view(p).z); }
  // View coordinates: x to the right, y up, z towards the viewer.
  Vec3 to_view(const Vec3& p) const {
    const double x = cos_azimuth_ * static_cast<double>(p.x) - sin_azimuth_ * static_cast<double>(p.y);
    const double y = sin_azimuth_ * static_cast<double>(p.x) + cos_azimuth_ * static_cast<double>(p.y);
    const double z = static_cast<double>(p.z);
    return {static_cast<float>(x), static_cast<float>(cos_elevation_ * z + sin_elevation_ * y),
            static_cast<float>(sin_elevation_ * z - cos_elevation_ * y)};
  }

 private:
  const DrawingOptions& options_;
  double cos_azimuth_, sin_azimuth_, cos_elevation_, sin_elevation_, scale_;
  Point center_{};
};

float scaled_length(float value, LengthScale scale) {
  return scale == LengthScale::root ? std::pow(value, 0.25f) : value;
}

Color patch_color(float value, float shading) {
  const Rgb c = viridis(0.12f + 0.88f * value) * (0.55f + 0.45f * shading);
  const auto byte = [](float v) { return static_cast<uint8_t>(std::clamp(v, 0.0f, 1.0f) * 255 + 0.5f); };
  return {byte(c.r), byte(c.g), byte(c.b), 1};
}

void add_patches(const LobeSurface& lobe, float largest, const View& view, LengthScale scale,
                 std::vector<Patch>& patches) {
  const auto columns = static_cast<size_t>(lobe.columns);
  const auto point = [&](size_t r, size_t c) {
    const size_t i = r * columns + c % columns;
    return lobe.directions[i] * scaled_length(lobe.values[i] / largest, scale);
  };
  for (size_t r = 0; r + 1 < static_cast<size_t>(lobe.rows); ++r)
    for (size_t c = 0; c < columns; ++c) {
      const Vec3 p[4] = {point(r, c), point(r, c + 1), point(r + 1, c + 1), point(r + 1, c)};
      const Vec3 mean = 0.25f * (p[0] + p[1] + p[2] + p[3]);
      if (length_squared(mean) < 1e-8f) continue;
      const Vec3 normal = normalize_or(glm::cross(view.to_view(p[2] - p[0]), view.to_view(p[3] - p[1])), Vec3(0, 0, 1));
      const float shading = std::abs(glm::dot(normal, glm::normalize(Vec3(0.4f, 0.6f, 0.7f))));
      Patch patch{{}, view.depth(mean), patch_color(lobe.values[r * columns + c] / largest, shading)};
      for (const Vec3& q : p) patch.corners.push_back(view.at(q));
      patches.push_back(std::move(patch));
    }
}

void draw_plane(const View& view, const metrics::ChartPalette& palette, Drawing& drawing) {
  for (const float radius : {0.5f, 1.0f}) {
    std::vector<Point> circle;
    for (int a = 0; a <= 360; a += 5) circle.push_back(view.at(direction(90, a) * radius));
    drawing.shapes.emplace_back(metrics::Polyline{circle, radius == 1 ? palette.grid : palette.minor_grid, 1, false});
  }
  drawing.shapes.emplace_back(
      metrics::Polyline{{view.at({-1, 0, 0}), view.at({1, 0, 0})}, palette.minor_grid, 1, false});
  drawing.shapes.emplace_back(
      metrics::Polyline{{view.at({0, -1, 0}), view.at({0, 1, 0})}, palette.minor_grid, 1, false});
}

void draw_arrow(const View& view, const Vec3& tip, const Color& color, const char* name, Drawing& drawing) {
  drawing.shapes.emplace_back(metrics::Polyline{{view.at(Vec3(0)), view.at(tip)}, color, 1.5});
  drawing.shapes.emplace_back(metrics::Dot{view.at(tip), 3.5, color, name});
  const Point p = view.at(tip * 1.06f);
  drawing.shapes.emplace_back(metrics::Text{{p.x, p.y - 4}, name, 13, color, metrics::Anchor::middle});
}

}  // namespace

Drawing lobe_drawing(std::span<const LobeSurface> sides, double degrees, const DrawingOptions& options) {
  float largest = 0;
  for (const LobeSurface& side : sides) largest = std::max(largest, side.largest);
  const View view(options, sides.size() > 1);
  Drawing drawing;
  drawing.width = options.width;
  drawing.height = options.height;
  drawing.title = "The lobe f cos as a surface";
  draw_plane(view, options.palette, drawing);
  std::vector<Patch> patches;
  if (largest > 0)
    for (const LobeSurface& side : sides) add_patches(side, largest, view, options.length_scale, patches);
  std::sort(patches.begin(), patches.end(), [](const Patch& a, const Patch& b) { return a.depth < b.depth; });
  for (Patch& patch : patches) drawing.shapes.emplace_back(metrics::Polygon{std::move(patch.corners), patch.color});
  draw_arrow(view, {0, 0, 1}, options.palette.secondary_text, "n", drawing);
  draw_arrow(view, direction(degrees), options.palette.text, "wo", drawing);
  return drawing;
}

}  // namespace etendue::bsdf_analysis
