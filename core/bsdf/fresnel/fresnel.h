// Fresnel reflectance of a smooth dielectric boundary, and Schlick's interpolation weight.
//
// Unpolarised light; real indices of refraction [Lang, eq. 4.67, 4.68, 4.72]. Conductors and the choice between
// approximations are in fresnel_term.h.
#pragma once
#include <utility>

#include "base/vec.h"

namespace etendue {

// The exact reflectance from the cosines of the incident and of the refracted direction; eta = eta_t / eta_i.
// Exchanging the sides (both cosines, and 1 / eta) gives the same value.
inline float fresnel_of_cosines(float cos_i, float cos_t, float eta) {
  const float parallel = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
  const float perpendicular = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
  return 0.5f * (sqr(parallel) + sqr(perpendicular));
}

// The exact reflectance from the cosine of the incident direction, in (0, 1]; eta = eta_t / eta_i. 1 for total internal
// reflection. `cos_t` receives the cosine of the refracted direction, 0 if there is none.
inline float fresnel_dielectric(float cos_i, float eta, float& cos_t) {
  const float sin2_t = (1 - sqr(cos_i)) / sqr(eta);
  if (sin2_t >= 1) {
    cos_t = 0;
    return 1;
  }
  cos_t = safe_sqrt(1 - sin2_t);
  return fresnel_of_cosines(cos_i, cos_t, eta);
}

// (1 - cos)^5, the weight of f90 in F = f0 + (f90 - f0) (1 - cos)^5 [Schlick 1993].
inline float schlick_weight(float cosine) {
  const float m = std::clamp(1 - cosine, 0.0f, 1.0f);
  return sqr(sqr(m)) * m;
}

// Reflectance of a dielectric boundary at normal incidence.
inline float f0_from_ior(float ior) { return sqr((ior - 1) / (ior + 1)); }

}  // namespace etendue
