// Rays that leave lights: the dual of sampling a light from a receiver.       thesis 9.2, (9.33)-(9.35); Veach
// 1997, 8.2
#include "base/frame.h"
#include "base/warp.h"
#include "light/light_table.h"
#include "light/punctual.h"

namespace etendue {
namespace {

// Point lights shine everywhere alike; a spot's rays fill its outer cone.
float pdf_direction(const Light& light) {
  if (light.type == LightType::point) return 1 / (4 * kPi);
  return 1 / (2 * kPi * std::max(1 - std::cos(light.outer_cone), 1e-7f));
}

// From the density of the cosine to that of a higher power of it, about the same axis.
Vec3 focused(const Vec3& d, float cosine_exponent) {
  const float sin2 = sqr(d.x) + sqr(d.y);
  const float z = std::pow(std::max(1 - sin2, 0.0f), 1 / (cosine_exponent + 2));
  const float scale = sin2 > 0 ? safe_sqrt((1 - z * z) / sin2) : 0;
  return {d.x * scale, d.y * scale, z};
}

}  // namespace

void LightTable::emit(const EmissionDraw& draw, Emission& e) const {
  if (choice_.empty()) return;
  const auto choice = choice_.sample(draw.choice);
  e.light = choice.index;
  e.time = draw.time;
  if (choice.index < triangles_.size()) return emit_from_triangle(draw, e);
  const size_t placed = choice.index - triangles_.size();
  if (placed < placed_.size()) {
    const LightType type = placed_[placed].light.type;
    if (type == LightType::ambient) return;  // comes from nowhere
    if (type != LightType::directional) return emit_from_point(choice, draw, e);
  }
  emit_from_infinity(choice, draw, e);
}

void LightTable::emit_from_triangle(const EmissionDraw& draw, Emission& e) const {
  const AreaLightTriangle& triangle = triangles_[e.light];
  if (triangle.round < 0)
    e.barycentric = square_to_triangle({draw.point.x, draw.point.y});
  else if (round_of(triangle).shape.kind == RoundShape::Kind::disk)
    e.barycentric = square_to_disk(draw.point);
  else
    e.barycentric = fold_direction(square_to_sphere(draw.point));
  leave_triangle(draw.direction, draw.cosine_direction, e);
  e.radiance = triangle.radiance, e.textured = triangle.textured;
  if (e.direction.z > 0 && e.density.first < kInfinity)
    e.weight = triangle.cosine_exponent == 0 ? kPi / (triangle.side_probability() * e.density.first)
                                             : e.direction.z / (e.density.first * e.density.second);
}

void LightTable::emit_from_point(const AliasTable::Choice& choice, const EmissionDraw& draw, Emission& e) const {
  const PlacedLight& placed = placed_[choice.index - triangles_.size()];
  e.kind = LightKind::placed;
  e.position = placed.at(draw.time).position;
  e.density = {choice.probability, pdf_direction(placed.light), true, false};
  leave_point(draw.direction, e);
  e.weight = 1 / (e.density.first * e.density.second);
}

void LightTable::emit_from_infinity(const AliasTable::Choice& choice, const EmissionDraw& draw, Emission& e) const {
  const size_t placed = choice.index - triangles_.size();
  if (placed < placed_.size()) {
    e.kind = LightKind::placed;
    e.direction = placed_[placed].at(draw.time).direction;
    e.density = {choice.probability, pdf_across(), true, true};
    e.radiance = placed_[placed].light.color * placed_[placed].light.intensity;
  } else {
    const auto sample = environment_.sample(draw.direction);
    e.kind = LightKind::environment;
    e.direction = -sample.direction;
    e.density = {choice.probability * sample.pdf_solid_angle, pdf_across(), false, true};
    e.radiance = environment_.radiance(sample.direction);
  }
  come_from_infinity(draw.point, e);
  if (e.density.first > 0) e.weight = 1 / (e.density.first * e.density.second);
}

// The direction under the cosine is that of `u`, which a light of two sides divides between them.
void LightTable::leave_triangle(const Vec2& u, const Vec3& cosine_direction, Emission& e) const {
  // Number by number: what was just written in parts stalls when it is copied as words.
  e.direction = {cosine_direction.x, cosine_direction.y, cosine_direction.z};
  if (triangles_[e.light].double_sided) {
    e.back = u.x >= 0.5f;
    const float x = std::min(2 * (u.x - (e.back ? 0.5f : 0)), kOneMinusEpsilon);
    e.direction = square_to_cosine_hemisphere({x, u.y});
  }
  if (const float cosine_exponent = triangles_[e.light].cosine_exponent; cosine_exponent != 0)
    e.direction = focused(e.direction, cosine_exponent);
  const EmissionDensity density = emission_density(e.light, e.direction.z, e.time);
  e.density.first = density.first, e.density.second = density.second;
  e.density.delta = false, e.density.infinite = false;
}

void LightTable::leave_point(Vec2 u, Emission& e) const {
  const PlacedLight& placed = placed_[e.light - triangles_.size()];
  const Light& light = placed.light;
  e.radiance = light.color * light.intensity;
  if (light.type == LightType::point) {
    e.direction = square_to_sphere(u);
  } else {
    const Vec3 local = square_to_cone(u, std::cos(light.outer_cone));
    e.direction = Frame(placed.at(e.time).direction).to_world(local);
    e.radiance *= spot_falloff(light, local.z);
  }
}

void LightTable::come_from_infinity(Vec2 u, Emission& e) const {
  const Vec2 across = square_to_disk(u) * radius_;
  const Frame frame(e.direction);
  e.position = centre_ + frame.x * across.x + frame.y * across.y - e.direction * radius_;
}

void LightTable::resample_emission(Vec2 u, Emission& e) const {
  if (e.kind == LightKind::triangle) return leave_triangle(u, square_to_cosine_hemisphere(u), e);
  if (e.kind == LightKind::environment || placed_[e.light - triangles_.size()].light.type == LightType::directional)
    return come_from_infinity(u, e);
  leave_point(u, e);
}

EmissionDensity LightTable::environment_emission_density(const Vec3& direction) const {
  return {pdf_environment(direction, LightStrategy::emission_pdf), pdf_across(), false, true};
}

EmissionDensity LightTable::density_of_other(const LightSample& sample) const {
  if (sample.kind == LightKind::environment) return environment_emission_density(sample.wi);
  const float choice = choice_.probability(sample.light);
  const Light& light = placed_[sample.light - triangles_.size()].light;
  if (light.type == LightType::ambient) return {choice, 0, true, true};
  if (light.type == LightType::directional) return {choice, pdf_across(), true, true};
  return {choice, pdf_direction(light), true, false};
}

float LightTable::range_window(uint32_t light, float distance) const {
  const size_t placed = light - triangles_.size();
  return light >= triangles_.size() && placed < placed_.size() && placed_[placed].light.type != LightType::directional
             ? etendue::range_window(placed_[placed].light, distance)
             : 1;
}

}  // namespace etendue
