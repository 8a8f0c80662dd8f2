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
  int top, bottom;  // rows of the texels
  Rgb top_left, top_right, bottom_left, bottom_right;
  Vec2 point{0};  // in [0, 1)^2
};

namespace {

// `column` is in [0, width], `row` in [0, height].
TexelPatch patch_of(const image::Image& map, int column, int row) {
  const int left = column == 0 ? map.width - 1 : column - 1, right = column == map.width ? 0 : column;
  const int top = std::max(row - 1, 0), bottom = std::min(row, map.height - 1);
  return {
      top, bottom, pixel(map, left, top), pixel(map, right, top), pixel(map, left, bottom), pixel(map, right, bottom)};
}

TexelPatch patch_at(const image::Image& map, Vec2 uv) {
  const float x = uv.x * static_cast<float>(map.width) + 0.5f;
  const float y = uv.y * static_cast<float>(map.height) + 0.5f;
  const int column = static_cast<int>(x), row = static_cast<int>(y);
  TexelPatch patch = patch_of(map, column, row);
  patch.point = Vec2(x - static_cast<float>(column), y - static_cast<float>(row));
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
  const Rgb tint = environment.spectrum.applied_to(environment.tint);
  environment_.tint = mean_ = tint;
  prepare_map();
  prepare_sun(tint);
  prepare_densities();
  prepare_backdrop();
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
  float largest = 0;
  for (int y = 0; y < map.height; ++y) {
    const float sine = sines_.emplace_back(row_sine(map, y));
    for (int x = 0; x < map.width; ++x) {
      const Rgb c = pixel(map, x, y);
      largest = std::max(largest, luminance(c) * sine);
      for (int i = 0; i < 3; ++i) sum[i] += c[i] * sine;
      solid_angle += sine;
    }
  }
  for (int i = 0; i < 3; ++i) mean_[i] *= static_cast<float>(sum[i] / solid_angle);
  if (largest > 0) largest_weight_ = largest;
}

EnvironmentMap::Corners EnvironmentMap::corners_of(const TexelPatch& p, float subtracted) const {
  const float top = sines_[static_cast<size_t>(p.top)], bottom = sines_[static_cast<size_t>(p.bottom)];
  const auto above = [&](const Rgb& texel, float sine) {
    return std::max(weight(texel, sine) - subtracted * sine, 0.0f);
  };
  return {
      {above(p.top_left, top), above(p.top_right, top), above(p.bottom_left, bottom), above(p.bottom_right, bottom)}};
}

// The sum of the weights of all texels.
float EnvironmentMap::total_weight() const {
  double total = 0;
  for (int y = 0; y < environment_.map->height; ++y)
    for (int x = 0; x < environment_.map->width; ++x)
      total += weight(pixel(*environment_.map, x, y), sines_[static_cast<size_t>(y)]);
  return static_cast<float>(total);
}

// The means of the patches: row by row, because maps have millions of texels.
Piecewise2D EnvironmentMap::patches_above(float subtracted) const {
  const int height = environment_.map->height;
  const auto width = static_cast<size_t>(environment_.map->width);
  std::vector<float> means(width * static_cast<size_t>(height + 1)), top(width), bottom(width);
  for (int row = 0; row <= height; ++row) {
    top = bottom;
    const int y = std::min(row, height - 1);
    const float sine = sines_[static_cast<size_t>(y)];
    for (size_t x = 0; x < width; ++x)
      bottom[x] = std::max(weight(pixel(*environment_.map, static_cast<int>(x), y), sine) - subtracted * sine, 0.0f);
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
    const float mean_weight = total_weight() / sum_of(sines_) / static_cast<float>(environment_.map->width);
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

Rgb EnvironmentMap::map_radiance(const TexelPatch& p) const {
  return environment_.tint *
         mix(mix(p.top_left, p.top_right, p.point.x), mix(p.bottom_left, p.bottom_right, p.point.x), p.point.y);
}

float EnvironmentMap::map_pdf(const TexelPatch& patch, float sine, const Density& density) const {
  if (!(sine > 0)) return 0;
  const float weight = corners_of(patch, density.subtracted).at(patch.point);
  return density_times_sine(weight, density.patches, *environment_.map) / sine;
}

EnvironmentMap::Sample EnvironmentMap::sample_map(Vec2 u, const Density& density) const {
  if (!environment_.map) return {square_to_sphere(u), uniform_pdf(density), environment_.tint};
  const image::Image& map = *environment_.map;
  const Vec2 at = density.patches.find(u) * Vec2(map.width, map.height + 1);
  const int column = static_cast<int>(at.x);
  const int row = static_cast<int>(at.y);
  TexelPatch patch = patch_of(map, column, row);
  const Corners corners = corners_of(patch, density.subtracted);
  patch.point = corners.sample(Vec2(at.x - static_cast<float>(column), at.y - static_cast<float>(row)));
  const Vec2 uv =
      Vec2(static_cast<float>(column) + patch.point.x - 0.5f, static_cast<float>(row) + patch.point.y - 0.5f) /
      Vec2(map.width, map.height);
  const float v = std::min(std::abs(uv.y), 2 - uv.y);
  const Vec2 polar = cos_sin_of_turns(v / 2);
  const Vec2 azimuth = cos_sin_of_turns(uv.x - 0.5f + environment_.rotation / (2 * kPi));
  const Vec3 direction(azimuth.x * polar.y, polar.x, azimuth.y * polar.y);
  const float times_sine = density_times_sine(corners.at(patch.point), density.patches, map);
  return {direction, polar.y > 0 ? times_sine / polar.y : 0, map_radiance(patch)};
}

EnvironmentMap::Value EnvironmentMap::map_value(const Vec3& direction, const Density& density) const {
  if (!environment_.map) return {environment_.tint, uniform_pdf(density)};
  const TexelPatch patch = patch_at(*environment_.map, uv_of(direction));
  return {map_radiance(patch), map_pdf(patch, safe_sqrt(1 - sqr(direction.y)), density)};
}

Rgb EnvironmentMap::radiance(const Vec3& direction) const {
  const Rgb radiance =
      environment_.map ? map_radiance(patch_at(*environment_.map, uv_of(direction))) : environment_.tint;
  return sun_ ? radiance + sun_->radiance(direction) : radiance;
}

EnvironmentMap::Value EnvironmentMap::value(const Vec3& direction, bool compensated) const {
  const Density& density = density_for(compensated);
  const Value map = map_value(direction, density);
  if (!sun_) return map;
  return {map.radiance + sun_->radiance(direction),
          mix(map.pdf_solid_angle, sun_->pdf(direction), density.sun_probability)};
}

EnvironmentMap::Sample EnvironmentMap::sample(Vec2 u, bool compensated) const {
  const Density& density = density_for(compensated);
  if (!sun_) return sample_map(u, density);
  const float p = density.sun_probability;
  Sample sample{};
  if (u.x < p)
    sample.direction = sun_->sample({u.x / p, u.y});
  else
    sample = sample_map({std::min((u.x - p) / (1 - p), kOneMinusEpsilon), u.y}, density);
  const Value value = this->value(sample.direction, compensated);
  sample.pdf_solid_angle = value.pdf_solid_angle;
  sample.radiance = value.radiance;
  return sample;
}

float EnvironmentMap::pdf_solid_angle(const Vec3& direction, bool compensated) const {
  return value(direction, compensated).pdf_solid_angle;
}

}  // namespace etendue
