#include "light/sampling/environment_map.h"

#include <algorithm>
#include <numeric>

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

}  // namespace

// The rectangle between four texel centres, and a point in it. Columns wrap around; beyond the first and the last row
// the patch repeats that row up to the pole.
struct TexelPatch {
  int left, right, top, bottom;  // columns and rows of the texels
  float x, y;                    // in [0, 1)
};

namespace {

TexelPatch patch_of(const image::Image& map, int column, int row) {
  return {(column + map.width - 1) % map.width,
          column % map.width,
          std::max(row - 1, 0),
          std::min(row, map.height - 1),
          0,
          0};
}

TexelPatch patch_at(const image::Image& map, Vec2 uv) {
  const float x = uv.x * static_cast<float>(map.width) + 0.5f;
  const float y = uv.y * static_cast<float>(map.height) + 0.5f;
  TexelPatch patch = patch_of(map, static_cast<int>(x), static_cast<int>(y));
  patch.x = x - std::floor(x);
  patch.y = y - std::floor(y);
  return patch;
}

template <class T>
T mix(const T& a, const T& b, float t) {
  return a * (1 - t) + b * t;
}

// A point of [0, 1] with a density that is linear from a to b.
float sample_linear(float u, float a, float b) {
  const float root = std::sqrt(mix(a * a, b * b, u));
  return a + root > 0 ? std::min(u * (a + b) / (a + root), 1.0f) : u;
}

// The density per solid angle times the sine of the polar angle, at a point with this weight.
float density_times_sine(float weight, const Piecewise2D& patches, const image::Image& map) {
  const float rows = static_cast<float>(map.height);
  const float total = patches.integral() * (rows + 1) / rows;
  return total > 0 ? weight / (total * 2 * kPi * kPi) : 0;
}

float sum_of(const std::vector<float>& values) {
  return static_cast<float>(std::accumulate(values.begin(), values.end(), 0.0));
}

Rgb mean_over_sphere(const SunCone& sun) { return sun.mean_radiance() * (sun.solid_angle() / (4 * kPi)); }

// How often the sun is sampled, by its share of the flux; the map is sampled as well.
float sun_probability(float share) {
  constexpr float kLeast = 0.1f;
  return std::clamp(share, kLeast, 1 - kLeast);
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

struct EnvironmentMap::Corners {
  float w[4];
  float at(Vec2 p) const { return mix(mix(w[0], w[1], p.x), mix(w[2], w[3], p.x), p.y); }
  Vec2 sample(Vec2 u) const {
    const float y = sample_linear(u.y, w[0] + w[1], w[2] + w[3]);
    return {sample_linear(u.x, mix(w[0], w[2], y), mix(w[1], w[3], y)), y};
  }
};

EnvironmentMap::EnvironmentMap(const Environment& environment) : environment_(environment) {
  environment_.tint = mean_ = environment.spectrum.applied_to(environment.tint);
  prepare_map();
  prepare_sun(mean_);
  prepare_densities();
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
    const float sine = sines_.emplace_back(row_sine(map, y));
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
}

EnvironmentMap::Corners EnvironmentMap::corners_of(const TexelPatch& p, float subtracted) const {
  const auto at = [&](int x, int y) {
    const auto row = static_cast<size_t>(y);
    const float weight = weights_[row * static_cast<size_t>(environment_.map->width) + static_cast<size_t>(x)];
    return std::max(weight - subtracted * sines_[row], 0.0f);
  };
  return {{at(p.left, p.top), at(p.right, p.top), at(p.left, p.bottom), at(p.right, p.bottom)}};
}

// The means of the patches: row by row, because maps have millions of texels.
Piecewise2D EnvironmentMap::patches_above(float subtracted) const {
  const int height = environment_.map->height;
  const auto width = static_cast<size_t>(environment_.map->width);
  std::vector<float> means(width * static_cast<size_t>(height + 1)), top(width), bottom(width);
  for (int row = 0; row <= height; ++row) {
    top = bottom;
    const auto y = static_cast<size_t>(std::min(row, height - 1));
    for (size_t x = 0; x < width; ++x) bottom[x] = std::max(weights_[y * width + x] - subtracted * sines_[y], 0.0f);
    if (row == 0) top = bottom;
    const float inside = row == 0 || row == height ? 0.5f : 1.0f;
    float* const mean = &means[static_cast<size_t>(row) * width];
    const auto mean_of = [&](size_t left, size_t right) {
      return inside * ((top[left] + top[right] + bottom[left] + bottom[right]) / 4);
    };
    mean[0] = mean_of(width - 1, 0);
    for (size_t x = 1; x < width; ++x) mean[x] = mean_of(x - 1, x);
  }
  return {means, environment_.map->width, height + 1};
}

// `tint` is that of the user; the one of a uniform map includes its radiance.
void EnvironmentMap::prepare_sun(const Rgb& tint) {
  if (!environment_.sun || is_black(environment_.sun->radiance)) return;
  const Vec3& d = environment_.sun->direction;
  const float c = std::cos(environment_.rotation), s = std::sin(environment_.rotation);
  SunDisk disk = *environment_.sun;
  disk.radiance *= tint;
  sun_.emplace(disk, Vec3(d.x * c - d.z * s, d.y, d.x * s + d.z * c));
  mean_ += mean_over_sphere(*sun_);
}

void EnvironmentMap::prepare_densities() {
  if (environment_.map) full_.patches = patches_above(0);
  const float mean = luminance(mean_), sun = sun_ ? luminance(mean_over_sphere(*sun_)) : 0;
  if (!(mean > 0)) return;
  if (sun_) full_.sun_probability = sun_probability(sun / mean);
  float above = 0;  // the mean of what the map exceeds the mean radiance by
  if (full_.patches.integral() > 0 && mean > sun) {
    const float mean_weight = sum_of(weights_) / sum_of(sines_) / static_cast<float>(environment_.map->width);
    compensated_.subtracted = mean_weight * mean / (mean - sun);
    compensated_.patches = patches_above(compensated_.subtracted);
    above = (mean - sun) * compensated_.patches.integral() / full_.patches.integral();
  }
  // Below this share, a light sample at every vertex costs more than it gains.
  constexpr float kLeastShare = 0.02f;
  const float share = (above + sun) / mean;
  if (share < kLeastShare) return;
  compensated_share_ = share;
  if (sun_) compensated_.sun_probability = above > 0 ? sun_probability(sun / (sun + above)) : 1;
}

Vec2 EnvironmentMap::uv_of(const Vec3& d) const {
  const float u = 0.5f + (fast_atan2(d.z, d.x) - environment_.rotation) / (2 * kPi);
  const float v = fast_acos(d.y) * kInvPi;
  return Vec2(std::min(u - std::floor(u), kOneMinusEpsilon), std::min(v, kOneMinusEpsilon));
}

Rgb EnvironmentMap::map_radiance(const Vec3& direction) const {
  if (!environment_.map) return environment_.tint;
  const image::Image& map = *environment_.map;
  const TexelPatch p = patch_at(map, uv_of(direction));
  return environment_.tint * mix(mix(pixel(map, p.left, p.top), pixel(map, p.right, p.top), p.x),
                                 mix(pixel(map, p.left, p.bottom), pixel(map, p.right, p.bottom), p.x), p.y);
}

EnvironmentMap::Sample EnvironmentMap::sample_map(Vec2 u, const Density& density) const {
  if (!environment_.map) return {square_to_sphere(u), uniform_pdf(density)};
  const image::Image& map = *environment_.map;
  const Vec2 size(map.width, map.height + 1);
  const Vec2 at = density.patches.sample(u).uv * size;
  const int column = static_cast<int>(at.x);
  const int row = static_cast<int>(at.y);
  const Corners corners = corners_of(patch_of(map, column, row), density.subtracted);
  const Vec2 inside = corners.sample(Vec2(at.x - std::floor(at.x), at.y - std::floor(at.y)));
  const Vec2 uv = Vec2(static_cast<float>(column) + inside.x - 0.5f, static_cast<float>(row) + inside.y - 0.5f) /
                  Vec2(map.width, map.height);
  const float v = std::min(std::abs(uv.y), 2 - uv.y);
  const float theta = v * kPi;
  const float phi = (uv.x - 0.5f) * 2 * kPi + environment_.rotation;
  const float sine = std::sin(theta);
  const Vec3 direction(std::cos(phi) * sine, std::cos(theta), std::sin(phi) * sine);
  return {direction, sine > 0 ? density_times_sine(corners.at(inside), density.patches, map) / sine : 0};
}

float EnvironmentMap::map_pdf(const Vec3& direction, const Density& density) const {
  if (!environment_.map) return uniform_pdf(density);
  const float sine = safe_sqrt(1 - sqr(direction.y));
  if (!(sine > 0)) return 0;
  const image::Image& map = *environment_.map;
  const TexelPatch p = patch_at(map, uv_of(direction));
  return density_times_sine(corners_of(p, density.subtracted).at({p.x, p.y}), density.patches, map) / sine;
}

Rgb EnvironmentMap::radiance(const Vec3& direction) const {
  const Rgb radiance = map_radiance(direction);
  return sun_ ? radiance + sun_->radiance(direction) : radiance;
}

Rgb EnvironmentMap::seen_radiance(const Vec3& direction) const {
  if (!shows_backdrop()) return radiance(direction);
  // The mean radiance is about that of a white surface.
  constexpr float kBelow = 0.28f, kAbove = 0.5f;
  const float t = std::clamp(0.5f + 0.8f * direction.y, 0.0f, 1.0f);
  return Rgb(luminance(mean_) * mix(kBelow, kAbove, t * t * (3 - 2 * t)));
}

EnvironmentMap::Sample EnvironmentMap::sample(Vec2 u, bool compensated) const {
  const Density& density = density_for(compensated);
  if (!sun_) return sample_map(u, density);
  const float p = density.sun_probability;
  Sample sample;
  if (u.x < p)
    sample.direction = sun_->sample({u.x / p, u.y});
  else
    sample = sample_map({std::min((u.x - p) / (1 - p), kOneMinusEpsilon), u.y}, density);
  sample.pdf_solid_angle = pdf_solid_angle(sample.direction, compensated);
  return sample;
}

float EnvironmentMap::pdf_solid_angle(const Vec3& direction, bool compensated) const {
  const Density& density = density_for(compensated);
  const float map = map_pdf(direction, density);
  return sun_ ? mix(map, sun_->pdf(direction), density.sun_probability) : map;
}

}  // namespace etendue
