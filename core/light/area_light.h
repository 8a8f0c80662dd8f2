// The surface of an area light.
#pragma once
#include <memory>
#include <variant>

#include "geometry/analytic_shape.h"
#include "spectrum/rgb.h"

namespace etendue {

struct AreaLight {
  // Around the origin, facing -z; lengths in metres.
  std::variant<std::shared_ptr<const Mesh>, AnalyticShape> shape;
  Rgb radiance;           // along the normal, cd/m^2
  float cosine_exponent;  // L(theta) = radiance cos^k(theta)
  bool two_sided;
  bool hit_by_rays;  // false if point samples replace it
};

}  // namespace etendue
