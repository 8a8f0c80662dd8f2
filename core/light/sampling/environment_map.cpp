#include "light/sampling/environment_map.h"

#include <algorithm>

#include "base/fast_trigonometry.h"
#include "base/warp.h"

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

// The rectangle between four texel centres, and a point in it. Columns wrap around; beyond the first and the last row
// the patch repeats that row up to the pole.
struct Patch {
  int left, right, top, bottom;  // columns and rows of the texels
  float x, y;                    // in [0, 1)
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
  const float x = uv.x * static_cast<float>(map.width) + 0.5f;
  const float y = uv.y * static_cast<float>(map.height) + 0.5f;
  Patch patch = patch_of(map, static_cast<int>(x), static_cast<int>(y));
  patch.x = x - std::floor(x);
  patch.y = y - std::floor(y);
  return patch;
}

template <class T>
T mix(const T& a, const T& b, float t) {
  return a * (1 - t) + b * t;
}

// The unnormalised density at the corners of a patch: top left, top right, bottom left, bottom right.
struct Corners {
  float w[4];
  float mean() const { return (w[0] + w[1] + w[2] + w[3]) / 4; }
  float at(float x, float y) const { return mix(mix(w[0], w[1], x), mix(w[2], w[3], x), y); }
};

// `weights` has the luminance times the sine of its row for each texel.
Corners corners_of(const std::vector<float>& weights, const image::Image& map, const Patch& p) {
  const auto at = [&](int x, int y) {
    return weights[static_cast<size_t>(y) * static_cast<size_t>(map.width) + static_cast<size_t>(x)];
  };
  return {at(p.left, p.top), at(p.right, p.top), at(p.left, p.bottom), at(p.right, p.bottom)};
}

// A point of [0, 1] with a density that is linear from a to b.
float sample_linear(float u, float a, float b) {
  const float root = std::sqrt(mix(a * a, b * b, u));
  return a + root > 0 ? std::min(u * (a + b) / (a + root), 1.0f) : u;
}

Vec2 sample_corners(Vec2 u, const Corners& c) {
  const float y = sample_linear(u.y, c.w[0] + c.w[1], c.w[2] + c.w[3]);
  return {sample_linear(u.x, mix(c.w[0], c.w[2], y), mix(c.w[1], c.w[3], y)), y};
}

// The density per solid angle times the sine of the polar angle, at a point with this weight.
float density_times_sine(float weight, const Piecewise2D& patches, const image::Image& map) {
  const float rows = static_cast<float>(map.height);
  const float total = patches.integral() * (rows + 1) / rows;
  return total > 0 ? weight / (total * 2 * kPi * kPi) : 0;
}

// Whether all texels have the same radiance above 0. A constant then replaces the map and its look-ups.
bool is_uniform(const image::Image& map) {
  const Rgb first = pixel(map, 0, 0);
  if (is_black(first)) return false;
  for (int y = 0; y < map.height; ++y)
    for (int x = 0; x < map.width; ++x)
      if (!(pixel(map, x, y) == first)) return false;
  return true;
}

}  // namespace

EnvironmentMap::EnvironmentMap(const Environment& environment) : environment_(environment) {
  environment_.tint = mean_ = environment.spectrum.applied_to(environment.tint);
  prepare_map();
  prepare_sun(mean_);
}

void EnvironmentMap::prepare_map() {
  if (!environment_.map || environment_.map->empty()) {
    environment_.map = nullptr;
    return;
  }
  const image::Image& map = *environment_.map;
  if (is_uniform(map)) {
    environment_.tint *= pixel(map, 0, 0);
    mean_ = environment_.tint;
    environment_.map = nullptr;
    return;
  }
  double sum[3] = {0, 0, 0};
  double solid_angle = 0;
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
  // Relative to the largest: squares of the largest float would overflow, and the density does not depend on scale.
  if (const float largest = *std::max_element(weights_.begin(), weights_.end()); largest > 0)
    for (float& w : weights_) w /= largest;

  std::vector<float> means;
  means.reserve(static_cast<size_t>(map.width) * static_cast<size_t>(map.height + 1));
  for (int row = 0; row <= map.height; ++row)
    for (int column = 0; column < map.width; ++column) {
      const float inside = row == 0 || row == map.height ? 0.5f : 1.0f;
      means.push_back(inside * corners_of(weights_, map, patch_of(map, column, row)).mean());
    }
  density_ = Piecewise2D(means, map.width, map.height + 1);
}

// `tint` is that of the user; the one of a uniform map includes its radiance.
void EnvironmentMap::prepare_sun(const Rgb& tint) {
  if (!environment_.sun || is_black(environment_.sun->radiance)) return;
  const Vec3& d = environment_.sun->direction;
  const float c = std::cos(environment_.rotation), s = std::sin(environment_.rotation);
  SunDisk disk = *environment_.sun;
  disk.radiance *= tint;
  sun_.emplace(disk, Vec3(d.x * c - d.z * s, d.y, d.x * s + d.z * c));
  const Rgb mean = sun_->mean_radiance() * (sun_->solid_angle() / (4 * kPi));
  mean_ += mean;
  constexpr float kLeast = 0.1f;
  const float share = luminance(mean_) > 0 ? luminance(mean) / luminance(mean_) : 0;
  sun_probability_ = std::clamp(share, kLeast, 1 - kLeast);
}

Vec2 EnvironmentMap::uv_of(const Vec3& d) const {
  const float u = 0.5f + (fast_atan2(d.z, d.x) - environment_.rotation) / (2 * kPi);
  const float v = fast_acos(d.y) * kInvPi;
  return Vec2(std::min(u - std::floor(u), kOneMinusEpsilon), std::min(v, kOneMinusEpsilon));
}

Rgb EnvironmentMap::map_radiance(const Vec3& direction) const {
  if (!environment_.map) return environment_.tint;
  const image::Image& map = *environment_.map;
  const Patch p = patch_at(map, uv_of(direction));
  return environment_.tint * mix(mix(pixel(map, p.left, p.top), pixel(map, p.right, p.top), p.x),
                                 mix(pixel(map, p.left, p.bottom), pixel(map, p.right, p.bottom), p.x), p.y);
}

EnvironmentMap::Sample EnvironmentMap::sample_map(Vec2 u) const {
  if (density_.empty()) return {square_to_sphere(u), 1 / (4 * kPi)};
  const image::Image& map = *environment_.map;
  const Vec2 size(map.width, map.height + 1);
  const Vec2 at = density_.sample(u).uv * size;
  const int column = static_cast<int>(at.x);
  const int row = static_cast<int>(at.y);
  const Corners corners = corners_of(weights_, map, patch_of(map, column, row));
  const Vec2 inside = sample_corners(Vec2(at.x - std::floor(at.x), at.y - std::floor(at.y)), corners);
  const Vec2 uv = Vec2(static_cast<float>(column) + inside.x - 0.5f, static_cast<float>(row) + inside.y - 0.5f) /
                  Vec2(map.width, map.height);
  const float v = std::min(std::abs(uv.y), 2 - uv.y);
  const float theta = v * kPi;
  const float phi = (uv.x - 0.5f) * 2 * kPi + environment_.rotation;
  const float sine = std::sin(theta);
  const Vec3 direction(std::cos(phi) * sine, std::cos(theta), std::sin(phi) * sine);
  return {direction, sine > 0 ? density_times_sine(corners.at(inside.x, inside.y), density_, map) / sine : 0};
}

float EnvironmentMap::map_pdf(const Vec3& direction) const {
  if (density_.empty()) return 1 / (4 * kPi);
  const float sine = safe_sqrt(1 - sqr(direction.y));
  if (!(sine > 0)) return 0;
  const image::Image& map = *environment_.map;
  const Patch p = patch_at(map, uv_of(direction));
  return density_times_sine(corners_of(weights_, map, p).at(p.x, p.y), density_, map) / sine;
}

Rgb EnvironmentMap::radiance(const Vec3& direction) const {
  const Rgb radiance = map_radiance(direction);
  return sun_ ? radiance + sun_->radiance(direction) : radiance;
}

EnvironmentMap::Sample EnvironmentMap::sample(Vec2 u) const {
  if (!sun_) return sample_map(u);
  Sample sample;
  if (u.x < sun_probability_) {
    sample.direction = sun_->sample({u.x / sun_probability_, u.y});
  } else {
    const float rest = (u.x - sun_probability_) / (1 - sun_probability_);
    sample = sample_map({std::min(rest, kOneMinusEpsilon), u.y});
  }
  sample.pdf_solid_angle = pdf_solid_angle(sample.direction);
  return sample;
}

float EnvironmentMap::pdf_solid_angle(const Vec3& direction) const {
  if (!sun_) return map_pdf(direction);
  return sun_probability_ * sun_->pdf(direction) + (1 - sun_probability_) * map_pdf(direction);
}

}  // namespace etendue
