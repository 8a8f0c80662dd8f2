#include <algorithm>

#include "base/warp.h"
#include "light/light_table.h"

namespace etendue {
namespace {

Rgb pixel(const image::Image& map, int x, int y) {
  const size_t at = (static_cast<size_t>(y) * static_cast<size_t>(map.width) + static_cast<size_t>(x)) *
                    static_cast<size_t>(map.channels);
  return {map.floats[at], map.floats[at + 1], map.floats[at + 2]};
}

float row_sine(const image::Image& map, int y) {
  return std::sin(kPi * (static_cast<float>(y) + 0.5f) / static_cast<float>(map.height));
}

// Four neighbouring texels, whose centres are the corners of a patch, and where in it a point lies. Columns go round;
// beyond the first and the last row, these go on to the pole.
struct Patch {
  int left, right, top, bottom;
  float x, y;
};

Patch patch_of(const image::Image& map, int column, int row) {
  return {(column + map.width - 1) % map.width,
          column % map.width,
          std::max(row - 1, 0),
          std::min(row, map.height - 1),
          0,
          0};
}

Patch patch_at(const image::Image& map, Vec2 uv) {
  const float x = uv.x * static_cast<float>(map.width) + 0.5f, y = uv.y * static_cast<float>(map.height) + 0.5f;
  Patch patch = patch_of(map, static_cast<int>(x), static_cast<int>(y));
  patch.x = x - std::floor(x), patch.y = y - std::floor(y);
  return patch;
}

template <class T>
T mix(const T& a, const T& b, float t) {
  return a * (1 - t) + b * t;
}

// What the density is proportional to, at the corners of a patch: top left, top right, bottom left, bottom right.
struct Corners {
  float w[4];
  float mean() const { return (w[0] + w[1] + w[2] + w[3]) / 4; }
  float at(float x, float y) const { return mix(mix(w[0], w[1], x), mix(w[2], w[3], x), y); }
};

// `weights` has one for each texel: its luminance times the sine of its row.
Corners corners_of(const std::vector<float>& weights, const image::Image& map, const Patch& p) {
  const auto at = [&](int x, int y) {
    return weights[static_cast<size_t>(y) * static_cast<size_t>(map.width) + static_cast<size_t>(x)];
  };
  return {at(p.left, p.top), at(p.right, p.top), at(p.left, p.bottom), at(p.right, p.bottom)};
}

// A point of [0, 1] whose density goes linearly from a to b.
float sample_linear(float u, float a, float b) {
  const float root = std::sqrt(mix(a * a, b * b, u));
  return a + root > 0 ? std::min(u * (a + b) / (a + root), 1.0f) : u;
}

Vec2 sample_corners(Vec2 u, const Corners& c) {
  const float y = sample_linear(u.y, c.w[0] + c.w[1], c.w[2] + c.w[3]);
  return {sample_linear(u.x, mix(c.w[0], c.w[2], y), mix(c.w[1], c.w[3], y)), y};
}

// Per solid angle times the sine, where the map has this weight.
float density_of(float weight, const Piecewise2D& patches, const image::Image& map) {
  const float rows = static_cast<float>(map.height);
  const float total = patches.integral() * (rows + 1) / rows;
  return total > 0 ? weight / (total * 2 * kPi * kPi) : 0;
}

}  // namespace

// Radiance is interpolated between texel centres, and so is the density: it follows a small sun up to its last edge,
// and radiance / density stays bounded. A patch between four centres is chosen by its mean, a point in it by its
// corners. The patches at the poles stick out of the map by half; what falls there is folded back.
EnvironmentMap::EnvironmentMap(const Environment& environment) : environment_(environment), mean_(environment.tint) {
  if (!environment_.map || environment_.map->empty()) {
    environment_.map = nullptr;
    return;
  }
  const image::Image& map = *environment_.map;
  double sum[3] = {0, 0, 0}, solid_angle = 0;
  weights_.reserve(static_cast<size_t>(map.width) * static_cast<size_t>(map.height));
  for (int y = 0; y < map.height; ++y) {
    const float sine = row_sine(map, y);
    for (int x = 0; x < map.width; ++x) {
      const Rgb c = pixel(map, x, y);
      weights_.push_back(luminance(c) * sine);
      for (int i = 0; i < 3; ++i) sum[i] += c[i] * sine;
      solid_angle += sine;
    }
  }
  for (int i = 0; i < 3; ++i) mean_[i] *= static_cast<float>(sum[i] / solid_angle);
  // One at most: the brightest that a file can hold has no square among floats, and densities know no scale.
  if (const float most = *std::max_element(weights_.begin(), weights_.end()); most > 0)
    for (float& w : weights_) w /= most;

  std::vector<float> means;
  means.reserve(static_cast<size_t>(map.width) * static_cast<size_t>(map.height + 1));
  for (int row = 0; row <= map.height; ++row)
    for (int column = 0; column < map.width; ++column) {
      const float inside = row == 0 || row == map.height ? 0.5f : 1.0f;
      means.push_back(inside * corners_of(weights_, map, patch_of(map, column, row)).mean());
    }
  density_ = Piecewise2D(means, map.width, map.height + 1);
}

Vec2 EnvironmentMap::uv_of(const Vec3& d) const {
  const float u = 0.5f + (std::atan2(d.z, d.x) - environment_.rotation) / (2 * kPi);
  const float v = std::acos(std::clamp(d.y, -1.0f, 1.0f)) * kInvPi;
  return Vec2(std::min(u - std::floor(u), kOneMinusEpsilon), std::min(v, kOneMinusEpsilon));
}

Rgb EnvironmentMap::radiance(const Vec3& direction) const {
  if (!environment_.map) return environment_.tint;
  const image::Image& map = *environment_.map;
  const Patch p = patch_at(map, uv_of(direction));
  return environment_.tint * mix(mix(pixel(map, p.left, p.top), pixel(map, p.right, p.top), p.x),
                                 mix(pixel(map, p.left, p.bottom), pixel(map, p.right, p.bottom), p.x), p.y);
}

EnvironmentMap::Sample EnvironmentMap::sample(Vec2 u) const {
  if (density_.empty()) return {square_to_sphere(u), 1 / (4 * kPi)};
  const image::Image& map = *environment_.map;
  const Vec2 size(map.width, map.height + 1);
  const Vec2 at = density_.sample(u).uv * size;
  const int column = static_cast<int>(at.x), row = static_cast<int>(at.y);
  const Corners corners = corners_of(weights_, map, patch_of(map, column, row));
  const Vec2 inside = sample_corners(Vec2(at.x - std::floor(at.x), at.y - std::floor(at.y)), corners);
  const Vec2 uv = Vec2(static_cast<float>(column) + inside.x - 0.5f, static_cast<float>(row) + inside.y - 0.5f) /
                  Vec2(map.width, map.height);
  const float v = std::min(std::abs(uv.y), 2 - uv.y);
  const float theta = v * kPi, phi = (uv.x - 0.5f) * 2 * kPi + environment_.rotation;
  const float sine = std::sin(theta);
  const Vec3 direction(std::cos(phi) * sine, std::cos(theta), std::sin(phi) * sine);
  return {direction, sine > 0 ? density_of(corners.at(inside.x, inside.y), density_, map) / sine : 0};
}

float EnvironmentMap::pdf_solid_angle(const Vec3& direction) const {
  if (density_.empty()) return 1 / (4 * kPi);
  const float sine = safe_sqrt(1 - sqr(direction.y));
  if (!(sine > 0)) return 0;
  const image::Image& map = *environment_.map;
  const Patch p = patch_at(map, uv_of(direction));
  return density_of(corners_of(weights_, map, p).at(p.x, p.y), density_, map) / sine;
}

}  // namespace etendue
