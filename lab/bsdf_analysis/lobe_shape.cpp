#include "bsdf_analysis/lobe_shape.h"

#include <algorithm>
#include <cmath>

#include "base/frame.h"

namespace etendue::bsdf_analysis {
namespace {

Rgb value_at(const Lobes& lobes, const Vec3& wo, const Vec3& wi, bool times_cosine) {
  const Rgb f = lobes.eval(wo, wi, TransportMode::radiance);
  if (!is_finite(f)) return Rgb(0);
  return times_cosine ? f * std::abs(wi.z) : f;
}

Vec3 refracted(const Vec3& wo, float eta) {
  const float x = wo.x / eta, y = wo.y / eta;
  return normalize_or(Vec3(-x, -y, -safe_sqrt(1 - x * x - y * y)), Vec3(0, 0, -1));
}

}  // namespace

Slice slice(const Lobes& lobes, double degrees, bool times_cosine, double azimuth, int steps) {
  const Vec3 wo = direction(degrees, azimuth);
  Slice s;
  s.degrees = degrees;
  for (int i = 0; i < steps; ++i) {
    const double angle = -180 + 360.0 * i / (steps - 1);
    s.angles.push_back(angle);
    s.values.push_back(
        value_at(lobes, wo, direction(std::abs(angle), angle < 0 ? azimuth + 180 : azimuth), times_cosine));
  }
  return s;
}

LobeSurface lobe_surface(const Lobes& lobes, double degrees, Side side, bool times_cosine, double azimuth) {
  constexpr int kRows = 72, kColumns = 72;
  const Vec3 wo = direction(degrees, azimuth);
  const Frame frame(side == Side::upper ? Vec3(-wo.x, -wo.y, wo.z) : refracted(wo, relative_eta(lobes)));
  LobeSurface surface;
  surface.rows = kRows;
  surface.columns = kColumns;
  for (int r = 0; r < kRows; ++r)
    for (int c = 0; c < kColumns; ++c) {
      const double t = static_cast<double>(r) / (kRows - 1);
      const Vec3 w = frame.to_world(direction(180 * t * t, 360.0 * c / kColumns));
      const bool on_side = side == Side::upper ? w.z > 0 : w.z < 0;
      surface.directions.push_back(w);
      surface.values.push_back(on_side ? average(value_at(lobes, wo, w, times_cosine)) : 0.0f);
      surface.largest = std::max(surface.largest, surface.values.back());
    }
  return surface;
}

}  // namespace etendue::bsdf_analysis
