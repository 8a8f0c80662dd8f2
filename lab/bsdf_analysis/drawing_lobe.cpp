#include <algorithm>
#include <cmath>

#include "bsdf_analysis/drawings.h"
#include "spectrum/colormap.h"

namespace etendue::bsdf_analysis {
namespace {

using metrics::Drawing;
using metrics::Ink;
using metrics::Spot;

struct Patch {
  std::vector<Spot> corners;
  double depth;  // towards the eye
  Ink ink;
};

class View {
 public:
  explicit View(const Look& look, bool below) : look_(look) {
    constexpr double kRadians = 3.14159265358979323846 / 180;
    cos_turn_ = std::cos(look.turn * kRadians), sin_turn_ = std::sin(look.turn * kRadians);
    cos_tilt_ = std::cos(look.tilt * kRadians), sin_tilt_ = std::sin(look.tilt * kRadians);
    // Room for the normal's name above, and for the disk, or the lower side, below.
    const double up = 1.2, down = below ? 1.1 : std::abs(sin_tilt_) + 0.05;
    scale_ = std::min(look.width / 2.1, look.height / (up + down));
    middle_ = {0.5 * look.width, up * scale_ + 0.5 * (look.height - (up + down) * scale_)};
  }

  Spot at(const Vec3& p) const {
    const Vec3 q = turned(p);
    return {middle_.x + scale_ * static_cast<double>(q.x), middle_.y - scale_ * static_cast<double>(q.y)};
  }
  double depth(const Vec3& p) const { return static_cast<double>(turned(p).z); }
  // x to the right, y up, z towards the eye.
  Vec3 turned(const Vec3& p) const {
    const double x = cos_turn_ * static_cast<double>(p.x) - sin_turn_ * static_cast<double>(p.y);
    const double y = sin_turn_ * static_cast<double>(p.x) + cos_turn_ * static_cast<double>(p.y);
    const double z = static_cast<double>(p.z);
    return {static_cast<float>(x), static_cast<float>(cos_tilt_ * z + sin_tilt_ * y),
            static_cast<float>(sin_tilt_ * z - cos_tilt_ * y)};
  }

 private:
  const Look& look_;
  double cos_turn_, sin_turn_, cos_tilt_, sin_tilt_, scale_;
  Spot middle_{};
};

float length_of(float share, Length length) { return length == Length::root ? std::pow(share, 0.25f) : share; }

Ink painted(float share, float light) {
  const Rgb c = viridis(0.12f + 0.88f * share) * (0.55f + 0.45f * light);
  const auto byte = [](float v) { return static_cast<uint8_t>(std::clamp(v, 0.0f, 1.0f) * 255 + 0.5f); };
  return {byte(c.r), byte(c.g), byte(c.b), 1};
}

void add_patches(const LobeSurface& lobe, float largest, const View& view, Length length, std::vector<Patch>& patches) {
  const auto columns = static_cast<size_t>(lobe.columns);
  const auto point = [&](size_t r, size_t c) {
    const size_t i = r * columns + c % columns;
    return lobe.directions[i] * length_of(lobe.values[i] / largest, length);
  };
  for (size_t r = 0; r + 1 < static_cast<size_t>(lobe.rows); ++r)
    for (size_t c = 0; c < columns; ++c) {
      const Vec3 p[4] = {point(r, c), point(r, c + 1), point(r + 1, c + 1), point(r + 1, c)};
      const Vec3 mean = 0.25f * (p[0] + p[1] + p[2] + p[3]);
      if (length_squared(mean) < 1e-8f) continue;
      const Vec3 normal = normalize_or(glm::cross(view.turned(p[2] - p[0]), view.turned(p[3] - p[1])), Vec3(0, 0, 1));
      const float light = std::abs(glm::dot(normal, glm::normalize(Vec3(0.4f, 0.6f, 0.7f))));
      Patch patch{{}, view.depth(mean), painted(lobe.values[r * columns + c] / largest, light)};
      for (const Vec3& q : p) patch.corners.push_back(view.at(q));
      patches.push_back(std::move(patch));
    }
}

void draw_plane(const View& view, const metrics::ChartPalette& palette, Drawing& drawing) {
  for (const float radius : {0.5f, 1.0f}) {
    std::vector<Spot> circle;
    for (int a = 0; a <= 360; a += 5) circle.push_back(view.at(direction(90, a) * radius));
    drawing.shapes.emplace_back(metrics::Stroke{circle, radius == 1 ? palette.line : palette.thin_line, 1, false});
  }
  drawing.shapes.emplace_back(metrics::Stroke{{view.at({-1, 0, 0}), view.at({1, 0, 0})}, palette.thin_line, 1, false});
  drawing.shapes.emplace_back(metrics::Stroke{{view.at({0, -1, 0}), view.at({0, 1, 0})}, palette.thin_line, 1, false});
}

void draw_arrow(const View& view, const Vec3& tip, const Ink& ink, const char* name, Drawing& drawing) {
  drawing.shapes.emplace_back(metrics::Stroke{{view.at(Vec3(0)), view.at(tip)}, ink, 1.5, false});
  drawing.shapes.emplace_back(metrics::Dot{view.at(tip), 3.5, ink, name});
  const Spot s = view.at(tip * 1.06f);
  drawing.shapes.emplace_back(metrics::Words{{s.x, s.y - 4}, name, 13, ink, metrics::Anchor::middle});
}

}  // namespace

Drawing lobe_drawing(std::span<const LobeSurface> sides, double degrees, const Look& look) {
  float largest = 0;
  for (const LobeSurface& side : sides) largest = std::max(largest, side.largest);
  const View view(look, sides.size() > 1);
  Drawing drawing;
  drawing.width = look.width, drawing.height = look.height;
  drawing.title = "The lobe f cos in space";
  draw_plane(view, look.palette, drawing);
  std::vector<Patch> patches;
  if (largest > 0)
    for (const LobeSurface& side : sides) add_patches(side, largest, view, look.length, patches);
  std::sort(patches.begin(), patches.end(), [](const Patch& a, const Patch& b) { return a.depth < b.depth; });
  for (Patch& patch : patches) drawing.shapes.emplace_back(metrics::Area{std::move(patch.corners), patch.ink});
  draw_arrow(view, {0, 0, 1}, look.palette.quiet, "n", drawing);
  draw_arrow(view, direction(degrees), look.palette.text, "wo", drawing);
  return drawing;
}

}  // namespace etendue::bsdf_analysis
