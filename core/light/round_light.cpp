// Points on spheres and disks: of a sphere those of the cone that it fills, of a disk all alike.
//                                             thesis item "area light"; Shirley, Wang and Zimmerman 1996; pbrt, 4th
//                                             ed., 6.2.4
#include "base/frame.h"
#include "base/warp.h"
#include "light/light_table.h"

namespace etendue {
namespace {

// The cone of directions to a sphere, from outside.
struct Cone {
  float sin2, one_minus_cos;

  Cone(float radius2, float distance2) : sin2(radius2 / distance2) {
    // Half the square of a small angle: the cosine is one there.
    one_minus_cos = sin2 < 1e-3f ? 0.5f * sin2 * (1 + 0.25f * sin2) : 1 - safe_sqrt(1 - sin2);
  }
  float pdf_solid_angle() const { return 1 / (2 * kPi * one_minus_cos); }
};

// The normal of the sphere where a direction of the cone meets it; `to_receiver` is unit.
Vec3 normal_seen(const Cone& cone, const Vec3& to_receiver, Vec2 u) {
  const float less = u.x * cone.one_minus_cos;  // one minus the cosine to the axis
  const float sin2 = less * (2 - less), share = std::min(sin2 / cone.sin2, 1.0f);
  // Between the axis and the normal: by the sines of the triangle of receiver, centre and point.
  const float cosine = sin2 / std::sqrt(cone.sin2) + (1 - less) * safe_sqrt(1 - share);
  const float sine = safe_sqrt(1 - sqr(cosine)), phi = 2 * kPi * u.y;
  const Frame frame(to_receiver);
  return frame.to_world(Vec3(sine * std::cos(phi), sine * std::sin(phi), cosine));
}

}  // namespace

void LightTable::sample_round(const AreaLightTriangle& t, float probability, const Vec3& from, Vec2 u, float time,
                              bool solid_angles, LightSample& sample) const {
  const RoundShape shape = round_of(t).at(time);
  sample.pdf = 0;
  if (shape.kind == RoundShape::Kind::disk) {
    sample.barycentric = square_to_disk(u);
  } else if (solid_angles) {
    const Vec3 out = from - shape.centre;
    const float distance2 = length_squared(out), radius2 = sqr(shape.radius);
    if (!(distance2 > radius2)) return;
    sample.barycentric = fold_direction(normal_seen(Cone(radius2, distance2), out / std::sqrt(distance2), u));
  } else {
    sample.barycentric = fold_direction(square_to_sphere(u));
  }
  const Vec3 point = shape.point_at(sample.barycentric), to_light = point - from;
  sample.distance = glm::length(to_light);
  if (!(sample.distance > 0)) return;
  sample.wi = to_light / sample.distance;
  const float facing = -glm::dot(shape.normal_at(sample.barycentric), sample.wi);
  if (t.double_sided ? facing == 0 : !(facing > 0)) return;
  sample.pdf = probability * pdf_of_point_on_round(t, from, point, time, solid_angles);
}

float LightTable::pdf_of_point_on_round(const AreaLightTriangle& t, const Vec3& from, const Vec3& at, float time,
                                        bool solid_angles) const {
  const RoundShape shape = round_of(t).at(time);
  if (shape.kind == RoundShape::Kind::sphere && solid_angles) {
    const float distance2 = glm::dot(from - shape.centre, from - shape.centre), radius2 = sqr(shape.radius);
    return distance2 > radius2 ? Cone(radius2, distance2).pdf_solid_angle() : 0;
  }
  const Vec3 to_light = at - from;
  const float distance2 = length_squared(to_light);
  const float facing = std::abs(glm::dot(shape.normal_at(shape.uv_of(at)), to_light));
  const float pdf = distance2 * std::sqrt(distance2) / (t.area * facing);
  return facing > 0 && pdf < kInfinity ? pdf : 0;
}

}  // namespace etendue
