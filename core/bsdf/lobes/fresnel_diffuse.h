// Diffuse reflection by the inside of a body with a smooth dielectric boundary.
//
//   f = A T(cos_o) T(cos_i) / (pi (1 - F)),   T = 1 - Fresnel reflectance,   F its hemispherical mean
//
// Light that enters, and has been reflected inside by the boundary as often as it takes, leaves with the angular
// distribution T cos / (pi (1 - F)), which integrates to one. A is therefore the share of the entered light that leaves
// again. Reciprocal; together with the reflection at the boundary it conserves energy: the albedos are A T and 1 - T.
// Sampled by the cosine.
#pragma once
#include "bsdf/fresnel/fresnel.h"
#include "bsdf/lobes/opaque_lobe.h"

namespace etendue {

template <class ColorType>
struct FresnelDiffuse : OpaqueLobe<ColorType, FresnelDiffuse<ColorType>, ScatterType::diffuse> {
  ColorType albedo{0};
  float eta = 1;               // inside over outside
  float mean_transmitted = 1;  // 1 - F

  ColorType f(const Vec3& o, const Vec3& i) const {
    return albedo * (transmitted(o.z) * transmitted(i.z) / (kPi * mean_transmitted));
  }
  float density(const Vec3&, const Vec3& i) const { return cosine_hemisphere_pdf(i.z); }
  bool sample_direction(const Vec3&, const LobeRandom& random, Vec3& i) const {
    i = random.cosine_direction;
    return true;
  }
  float sampling_weight(const Vec3& wo) const { return average(albedo) * transmitted(std::abs(wo.z)); }
  float alpha() const { return 1; }

 private:
  float transmitted(float cosine) const {
    if (eta == 1) return 1;
    float refracted;
    return 1 - fresnel_dielectric(cosine, eta, refracted);
  }
};

}  // namespace etendue
