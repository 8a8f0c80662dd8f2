// Fresnel reflectance.                                                    thesis 4.1.3, (4.83)-(4.90), errata E3, E5
#pragma once
#include <utility>

#include "base/vec.h"

namespace etendue {

// Unpolarised reflectance of a smooth dielectric, exact, from both cosines: of a direction and of the refracted one.
// Alike from either side.
inline float fresnel_of_cosines(float cos_i, float cos_t, float eta) {
  const float parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
  const float perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
  return 0.5f * (sqr(parallel) + sqr(perpendicular));
}

// The same from the direction alone. `cos_i` is the cosine on the side that the direction lies on,
// in (0, 1]; `eta` = eta_t / eta_i. One under total internal reflection. `cos_t` receives the refracted cosine (0 if
// none).
inline float fresnel_dielectric(float cos_i, float eta, float& cos_t) {
  const float sin2_t = (1 - sqr(cos_i)) / sqr(eta);
  if (sin2_t >= 1) {
    cos_t = 0;
    return 1;
  }
  cos_t = safe_sqrt(1 - sin2_t);
  return fresnel_of_cosines(cos_i, cos_t, eta);
}

// Schlick's weight (1 - cos)^5: F = f0 + (f90 - f0) * weight.
inline float schlick_weight(float cosine) {
  const float m = std::clamp(1 - cosine, 0.0f, 1.0f);
  return sqr(sqr(m)) * m;
}

// Reflectance at normal incidence of a dielectric boundary.
inline float f0_from_ior(float ior) { return sqr((ior - 1) / (ior + 1)); }

}  // namespace etendue
