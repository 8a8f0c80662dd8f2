#include "base/warp.h"
#include "light/light_table.h"

namespace etendue {
namespace {

Rgb pixel(const image::Image& map, int x, int y) {
  const size_t at = (static_cast<size_t>(y) * static_cast<size_t>(map.width) + static_cast<size_t>(x)) *
                    static_cast<size_t>(map.channels);
  return {map.floats[at], map.floats[at + 1], map.floats[at + 2]};
}

}  // namespace

// The density is that of the picture's own cells: looking up nearest texels keeps radiance / density bounded by the
// sine.
EnvironmentMap::EnvironmentMap(const Environment& environment) : environment_(environment), mean_(environment.tint) {
  if (!environment_.map || environment_.map->empty()) {
    environment_.map = nullptr;
    return;
  }
  const image::Image& map = *environment_.map;
  std::vector<float> weights(static_cast<size_t>(map.width) * static_cast<size_t>(map.height));
  double sum[3] = {0, 0, 0}, solid_angle = 0;
  for (int y = 0; y < map.height; ++y) {
    const float sine = std::sin(kPi * (static_cast<float>(y) + 0.5f) / static_cast<float>(map.height));
    for (int x = 0; x < map.width; ++x) {
      const Rgb c = pixel(map, x, y);
      weights[static_cast<size_t>(y) * static_cast<size_t>(map.width) + static_cast<size_t>(x)] = luminance(c) * sine;
      for (int i = 0; i < 3; ++i) sum[i] += c[i] * sine;
      solid_angle += sine;
    }
  }
  density_ = Piecewise2D(weights, map.width, map.height);
  for (int i = 0; i < 3; ++i) mean_[i] *= static_cast<float>(sum[i] / solid_angle);
}

Vec2 EnvironmentMap::uv_of(const Vec3& d) const {
  const float u = 0.5f + (std::atan2(d.z, d.x) - environment_.rotation) / (2 * kPi);
  const float v = std::acos(std::clamp(d.y, -1.0f, 1.0f)) * kInvPi;
  return Vec2(std::min(u - std::floor(u), kOneMinusEpsilon), std::min(v, kOneMinusEpsilon));
}

Rgb EnvironmentMap::radiance(const Vec3& direction) const {
  if (!environment_.map) return environment_.tint;
  const image::Image& map = *environment_.map;
  const Vec2 uv = uv_of(direction);
  return environment_.tint * pixel(map, static_cast<int>(uv.x * static_cast<float>(map.width)),
                                   static_cast<int>(uv.y * static_cast<float>(map.height)));
}

EnvironmentMap::Sample EnvironmentMap::sample(Vec2 u) const {
  if (density_.empty()) return {square_to_sphere(u), 1 / (4 * kPi)};
  const auto s = density_.sample(u);
  const float theta = s.uv.y * kPi, phi = (s.uv.x - 0.5f) * 2 * kPi + environment_.rotation;
  const float sine = std::sin(theta);
  const Vec3 direction(std::cos(phi) * sine, std::cos(theta), std::sin(phi) * sine);
  return {direction, sine > 0 ? s.pdf / (2 * kPi * kPi * sine) : 0};
}

float EnvironmentMap::pdf_solid_angle(const Vec3& direction) const {
  if (density_.empty()) return 1 / (4 * kPi);
  const float sine = safe_sqrt(1 - sqr(direction.y));
  return sine > 0 ? density_.pdf(uv_of(direction)) / (2 * kPi * kPi * sine) : 0;
}

}  // namespace etendue
