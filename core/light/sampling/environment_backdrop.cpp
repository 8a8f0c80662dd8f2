// The grey gradient that the camera sees in place of an environment.
#include <algorithm>
#include <cmath>

#include "light/sampling/environment_map.h"

namespace etendue {
namespace {

// Rows of the map that take part; finer details hardly change the irradiance.
constexpr int kMaxRows = 64;

// Unit vectors towards the faces, edges and corners of a cube.
std::vector<Vec3> orientations() {
  std::vector<Vec3> list;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z)
        if (x != 0 || y != 0 || z != 0) list.push_back(glm::normalize(Vec3(x, y, z)));
  return list;
}

// Adds the luminance of a white diffuse surface in the light of the map, for each orientation.
void add_map(const image::Image& map, const Rgb& tint, const std::vector<Vec3>& normals, std::vector<float>& white) {
  const int step = std::max(1, map.height / kMaxRows);
  const auto channels = static_cast<size_t>(map.channels);
  const auto center = [](int i, int count) { return (static_cast<float>(i) + 0.5f) / static_cast<float>(count); };
  const float d_theta = kPi * static_cast<float>(step) / static_cast<float>(map.height);
  const float d_phi = 2 * kPi * static_cast<float>(step) / static_cast<float>(map.width);
  for (int y = step / 2; y < map.height; y += step) {
    const float theta = kPi * center(y, map.height), sine = std::sin(theta);
    for (int x = step / 2; x < map.width; x += step) {
      const float phi = 2 * kPi * (center(x, map.width) - 0.5f);
      const Vec3 direction(std::cos(phi) * sine, std::cos(theta), std::sin(phi) * sine);
      const float* texel =
          &map.floats[(static_cast<size_t>(y) * static_cast<size_t>(map.width) + static_cast<size_t>(x)) * channels];
      const float radiance = luminance(tint * Rgb(texel[0], texel[1], texel[2])) * (sine * d_theta * d_phi * kInvPi);
      for (size_t i = 0; i < normals.size(); ++i)
        white[i] += radiance * std::max(0.0f, glm::dot(normals[i], direction));
    }
  }
}

}  // namespace

void EnvironmentMap::prepare_backdrop() {
  if (!shows_backdrop()) return;
  // The rotation about the vertical axis does not matter.
  std::vector<Vec3> normals = orientations();
  if (sun_) normals.push_back(glm::normalize(environment_.sun->direction));
  std::vector<float> white(normals.size(), environment_.map ? 0 : luminance(environment_.tint));
  if (environment_.map) add_map(*environment_.map, environment_.tint, normals, white);
  if (sun_) {
    const float irradiance = luminance(sun_->mean_radiance()) * sun_->solid_angle();
    for (size_t i = 0; i < normals.size(); ++i)
      white[i] += irradiance * kInvPi * std::max(0.0f, glm::dot(normals[i], normals.back()));
  }
  backdrop_white_ = environment_.backdrop_brightness * *std::ranges::max_element(white);
}

Rgb EnvironmentMap::seen_radiance(const Vec3& direction) const {
  if (!shows_backdrop()) return radiance(direction);
  // Middle grey, 18 % of white, is just below the horizon, where most cameras look.
  constexpr float kBelow = 0.12f, kAbove = 0.36f;
  const float t = 0.5f + 0.5f * std::clamp(direction.y, -1.0f, 1.0f);
  return Rgb(backdrop_white_ * (kBelow + (kAbove - kBelow) * t * t * (3 - 2 * t)));
}

}  // namespace etendue
