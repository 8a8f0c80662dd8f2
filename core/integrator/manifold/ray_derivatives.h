// The derivatives of a ray that surfaces reflect and refract.                                          [Igehy 1999]
//
// The ray depends on two parameters. All derivatives are those by the two parameters.
#pragma once
#include <array>
#include <cmath>

#include "base/frame.h"

namespace etendue::integrator::manifold {

using Derivative = std::array<Vec3, 2>;

// A surface at the point where a ray meets it: its shading normal, and how that changes on the surface.
struct CurvedSurface {
  Vec3 ng;            // geometric normal, unit
  Vec3 normal;        // shading normal, unit
  Vec3 e1, e2;        // edges of its triangle
  Vec3 dn_du, dn_dv;  // derivatives of the shading normal along e1 and e2

  // A vector in the plane of the triangle in terms of its edges; 0 if it has no area.
  Vec2 coordinates(const Vec3& v) const {
    const float a = glm::dot(e1, e1), b = glm::dot(e1, e2), c = glm::dot(e2, e2);
    const float p = glm::dot(v, e1), q = glm::dot(v, e2), determinant = a * c - b * b;
    return determinant > 0 ? Vec2(p * c - q * b, q * a - p * b) / determinant : Vec2(0);
  }
  // The change of the normal if the point on the surface moves by `step`, in its plane.
  Vec3 normal_derivative(const Vec3& step) const {
    const Vec2 uv = coordinates(step);
    return dn_du * uv.x + dn_dv * uv.y;
  }
};

struct RayDerivatives {
  Derivative origin{Vec3(0), Vec3(0)}, direction{Vec3(0), Vec3(0)};

  // Of a ray from a point towards `direction`, a unit vector; the parameters move the direction along the axes x and y
  // of the frame, whose z axis it is.
  static RayDerivatives around(const Frame& frame) {
    RayDerivatives d;
    d.direction = {frame.x, frame.y};
    return d;
  }

  // Moves the origin along the ray to a surface at this distance.
  void transfer(const Vec3& ray_direction, float distance, const Vec3& ng) {
    const float cosine = glm::dot(ray_direction, ng);
    for (size_t k = 0; k < 2; ++k) {
      const Vec3 moved = origin[k] + direction[k] * distance;
      origin[k] = moved - ray_direction * (glm::dot(moved, ng) / cosine);
    }
  }

  // Reflects the ray, whose origin lies on the surface.
  void reflect(const Vec3& ray_direction, const CurvedSurface& surface) {
    const Vec3& n = surface.normal;
    const float cosine = glm::dot(ray_direction, n);
    for (size_t k = 0; k < 2; ++k) {
      const Vec3 dn = surface.normal_derivative(origin[k]);
      const float dcosine = glm::dot(direction[k], n) + glm::dot(ray_direction, dn);
      direction[k] -= 2.0f * (n * dcosine + dn * cosine);
    }
  }

  // Refracts the ray, whose origin lies on the surface. `eta` is the index of refraction on the side that the ray
  // enters over that on the side from which it comes.
  void refract(const Vec3& ray_direction, float eta, const CurvedSurface& surface) {
    const float side = glm::dot(ray_direction, surface.normal) < 0 ? 1.0f : -1.0f;
    const Vec3 n = surface.normal * side;
    const float mu = 1 / eta, cosine = -glm::dot(ray_direction, n);
    const float refracted = std::sqrt(std::max(0.0f, 1 - sqr(mu) * (1 - sqr(cosine))));
    for (size_t k = 0; k < 2; ++k) {
      const Vec3 dn = surface.normal_derivative(origin[k]) * side;
      const float dcosine = -(glm::dot(direction[k], n) + glm::dot(ray_direction, dn));
      const float drefracted = sqr(mu) * cosine * dcosine / refracted;
      direction[k] = direction[k] * mu + n * (mu * dcosine - drefracted) + dn * (mu * cosine - refracted);
    }
  }
};

// The derivatives of a point on a ray, in the plane across the ray; of the direction if the point is at infinity.
struct EndDerivatives {
  std::array<Vec2, 2> column{Vec2(0), Vec2(0)};

  float determinant() const { return column[0].x * column[1].y - column[1].x * column[0].y; }
};

// The z axis of the frame is the direction of the ray.
inline EndDerivatives end_derivatives(const RayDerivatives& ray, const Frame& across, float distance) {
  EndDerivatives end;
  for (size_t k = 0; k < 2; ++k) {
    const Vec3 v = std::isinf(distance) ? ray.direction[k] : ray.origin[k] + ray.direction[k] * distance;
    end.column[k] = Vec2(glm::dot(v, across.x), glm::dot(v, across.y));
  }
  return end;
}

}  // namespace etendue::integrator::manifold
