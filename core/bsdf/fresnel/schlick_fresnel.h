// The Fresnel term of the glTF specular layer, a mixture of a dielectric and a metal.     [glTF 2.0, appendix B.3.4]
//
//   F = f0 + (f90 - f0) (1 - cos)^5,       cos to the normal of the microfacet
//
// The diffuse base below the layer receives the part 1 - layer_reflectance, which depends on the dielectric alone.
#pragma once
#include "bsdf/fresnel/fresnel.h"
#include "bsdf/microfacet/ggx_albedo.h"

namespace etendue {

template <class Color>
struct SchlickFresnel {
  Color f0{0}, f90{0};                          // of the mixture
  float dielectric_f0 = 0, dielectric_f90 = 0;  // of the dielectric, the maximum over the colour components

  Color fresnel(float cosine) const { return f0 + (f90 - f0) * schlick_weight(cosine); }
  // Reflectance of the dielectric, the maximum over the colour components.
  float layer_reflectance(float cosine) const {
    return dielectric_f0 + (dielectric_f90 - dielectric_f0) * schlick_weight(cosine);
  }

  // The same terms averaged over microfacets: the directional albedo of the layer.
  Color albedo(const GgxAlbedo& e) const { return f0 * e.a + f90 * e.b; }
  float layer_albedo(const GgxAlbedo& e) const { return dielectric_f0 * e.a + dielectric_f90 * e.b; }
  // The cosine-weighted mean of layer_albedo over the hemisphere.
  float mean_layer_albedo(float alpha) const { return layer_albedo(GgxAlbedoRow(alpha).mean()); }

  bool reflects() const { return !is_black(f90); }
};

}  // namespace etendue
