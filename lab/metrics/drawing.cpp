#include "metrics/drawing.h"

#include <algorithm>
#include <cmath>

namespace etendue::metrics {
namespace {

constexpr double kDash = 6, kGap = 4;  // as in the SVG

Spot between(const Spot& a, const Spot& b, double t) { return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)}; }

}  // namespace

std::vector<std::array<Spot, 2>> dashes_of(const Stroke& stroke) {
  std::vector<std::array<Spot, 2>> dashes;
  double along = 0;  // how far into the pattern the segment begins
  for (size_t i = 1; i < stroke.points.size(); ++i) {
    const Spot &a = stroke.points[i - 1], &b = stroke.points[i];
    const double length = std::hypot(b.x - a.x, b.y - a.y), period = kDash + kGap;
    for (double start = -std::fmod(along, period); start < length; start += period) {
      const double from = std::max(start, 0.0), to = std::min(start + kDash, length);
      if (from < to) dashes.push_back({between(a, b, from / length), between(a, b, to / length)});
    }
    along += length;
  }
  return dashes;
}

}  // namespace etendue::metrics
