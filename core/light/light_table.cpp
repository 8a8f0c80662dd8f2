#include "light/light_table.h"

#include "base/warp.h"

namespace etendue {
namespace {

float power_of(const EmissiveTriangle& t) {
  return kPi * t.area() * luminance(t.radiance) * (t.double_sided ? 2.0f : 1.0f);
}

float power_of(const PlacedLight& placed, float scene_radius) {
  const Light& light = placed.light;
  const float intensity = luminance(light.color) * light.intensity;
  switch (light.type) {
    case LightType::point:
      return 4 * kPi * intensity;
    case LightType::spot:
      return kPi * (2 - std::cos(light.inner_cone) - std::cos(light.outer_cone)) * intensity;
    case LightType::directional:
      return kPi * sqr(scene_radius) * intensity;
  }
  return 0;
}

// The falloff that KHR_lights_punctual recommends, between the cosines of the two cones.
float spot_falloff(const Light& light, float cosine) {
  const float outer = std::cos(light.outer_cone);
  const float scale = 1 / std::max(0.001f, std::cos(light.inner_cone) - outer);
  return sqr(std::clamp((cosine - outer) * scale, 0.0f, 1.0f));
}

// The window that KHR_lights_punctual recommends for a light with a range.
float range_window(const Light& light, float distance) {
  if (!std::isfinite(light.range)) return 1;
  return std::clamp(1 - sqr(sqr(distance / light.range)), 0.0f, 1.0f);
}

}  // namespace

LightTable::LightTable(std::vector<EmissiveTriangle> triangles, std::vector<PlacedLight> placed,
                       const Environment& environment, const Bounds& scene_bounds)
    : triangles_(std::move(triangles)), placed_(std::move(placed)), environment_(environment) {
  const float radius = std::max(scene_bounds.radius(), 1e-6f);
  std::vector<float> powers;
  powers.reserve(triangles_.size() + placed_.size() + 1);
  for (const auto& t : triangles_) powers.push_back(power_of(t));
  for (const auto& l : placed_) powers.push_back(power_of(l, radius));
  if (!environment_.black()) powers.push_back(4 * sqr(kPi * radius) * luminance(environment_.mean_radiance()));
  bool any = false;
  for (const float p : powers) any = any || p > 0;
  if (any) choice_ = AliasTable(powers);
}

bool LightTable::sample(const Vec3& from, float u_choice, Vec2 u, LightSample& sample) const {
  if (choice_.empty()) return false;
  const auto choice = choice_.sample(u_choice);
  sample.light = choice.index;
  bool reached = false;
  if (choice.index < triangles_.size()) {
    reached = sample_triangle(choice.index, from, u, sample);
  } else if (choice.index < triangles_.size() + placed_.size()) {
    reached = sample_placed(placed_[choice.index - triangles_.size()], from, sample);
  } else {
    const auto direction = environment_.sample(u);
    sample.kind = LightKind::environment;
    sample.wi = direction.direction;
    sample.distance = kInfinity;
    sample.pdf = direction.pdf_solid_angle;
    sample.delta = false;
    sample.radiance = environment_.radiance(direction.direction);
    reached = sample.pdf > 0;
  }
  sample.pdf *= choice.probability;
  return reached && sample.pdf > 0;
}

bool LightTable::sample_triangle(uint32_t light, const Vec3& from, Vec2 u, LightSample& sample) const {
  const EmissiveTriangle& t = triangles_[light];
  const Vec2 b = square_to_triangle(u);
  const Vec3 to_light = t.p0 + b.x * t.e1 + b.y * t.e2 - from;
  const float distance2 = length_squared(to_light);
  if (!(distance2 > 0)) return false;
  const float distance = std::sqrt(distance2);
  sample.kind = LightKind::triangle;
  sample.wi = to_light / distance;
  sample.distance = distance;
  // 2 * area * cosine, of the side that faces the receiver.
  const float facing = glm::dot(glm::cross(t.e1, t.e2), sample.wi) * (t.turned ? 1.0f : -1.0f);
  if (facing == 0 || (facing < 0 && !t.double_sided)) return false;
  sample.pdf = 2 * distance2 / std::abs(facing);
  sample.delta = false;
  sample.radiance = t.radiance;
  sample.barycentric = b;
  return std::isfinite(sample.pdf);
}

bool LightTable::sample_placed(const PlacedLight& placed, const Vec3& from, LightSample& sample) const {
  const Light& light = placed.light;
  sample.kind = LightKind::placed;
  sample.delta = true;
  sample.pdf = 1;
  sample.radiance = light.color * light.intensity;
  if (light.type == LightType::directional) {
    sample.wi = -placed.direction;
    sample.distance = kInfinity;
    return true;
  }
  const Vec3 to_light = placed.position - from;
  const float distance2 = length_squared(to_light);
  if (!(distance2 > 0)) return false;
  sample.distance = std::sqrt(distance2);
  sample.wi = to_light / sample.distance;
  sample.radiance *= range_window(light, sample.distance) / distance2;
  if (light.type == LightType::spot) sample.radiance *= spot_falloff(light, -glm::dot(sample.wi, placed.direction));
  return !is_black(sample.radiance);
}

float LightTable::pdf_triangle(uint32_t light, const Vec3& from, const Vec3& at) const {
  if (choice_.empty() || light >= triangles_.size()) return 0;
  const EmissiveTriangle& t = triangles_[light];
  const Vec3 to_light = at - from;
  const float distance2 = length_squared(to_light);
  const float facing = std::abs(glm::dot(glm::cross(t.e1, t.e2), to_light));
  if (!(facing > 0)) return 0;
  return choice_.probability(light) * 2 * distance2 * std::sqrt(distance2) / facing;
}

float LightTable::pdf_environment(const Vec3& direction) const {
  if (choice_.empty() || environment_.black()) return 0;
  return choice_.probability(static_cast<uint32_t>(choice_.size() - 1)) * environment_.pdf_solid_angle(direction);
}

}  // namespace etendue
