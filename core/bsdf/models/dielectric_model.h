// The boundary of a clear solid such as glass or water, polished or rough.
//                                                              [Lang, eq. 4.117-4.133, corrected; Walter et al. 2007]
//   f_r = F D G2 / (4 cos_o cos_i),   f_t: see lobes/dielectric.h
//
//   Parameters   eta: index of refraction of the inside over that of the outside; roughness: alpha of GGX, 0 is
//                polished. The base colour multiplies the transmitted light.
//   Properties   Reciprocal up to the eta^2 law, f(i -> o) / eta_o^2 = f(o -> i) / eta_i^2 [Lang, eq. 4.301]. A
//                polished boundary with a white base colour loses no energy.
//   Sampling     Polished: reflection or refraction in proportion to F. Rough: a visible normal first, then in
//                proportion to F.
//   Limitations  A rough boundary loses the light that its microfacets scatter more than once.
#pragma once
#include "bsdf/bsdf_model_info.h"
#include "bsdf/fresnel/optical_constants.h"
#include "bsdf/lobes/dielectric.h"

namespace etendue {

struct DielectricModel {
  static constexpr BsdfModelDescription kDescription{
      .name = "dielectric",
      .label = "Dielectric (glass, water)",
      .model_class = ModelClass::physical,
      .summary =
          "The boundary of a clear solid: reflection and refraction with exact Fresnel terms, smooth or with GGX "
          "microfacets.",
      .formula =
          "f_r = F D G2 / (4 cos_o cos_i)\n"
          "f_t = (1 - F) D G2 |<wo, h> <wi, h>| / (|cos_o cos_i| (<wo, h> + eta_i / eta_o <wi, h>)^2)  (radiance)",
      .properties = "Reciprocal up to the eta^2 law. A polished boundary loses no energy.",
      .sampling = "Polished: reflection or refraction by F. Rough: visible normals, then by F.",
      .limitations = "A rough boundary loses the light that its microfacets scatter more than once.",
      .source = "[Lang, eq. 4.117-4.133, corrected], [Walter et al. 2007]",
  };
  static constexpr bool kSolid = true;
  template <class Color>
  using Lobes = std::tuple<Dielectric<Color>>;

  Number<float> eta{"eta",
                    "IOR \u03b7",
                    1.5f,
                    {0.3f, 4},
                    "Index of refraction of the inside over that of the outside; 1 removes the boundary"};
  Number<float> roughness{
      "roughness", "Roughness \u03b1", 0, {0, 1}, "Higher blurs reflection and refraction; 0 is polished"};
  auto parameters() { return std::tie(eta, roughness); }
  static std::vector<ModelPreset> presets() { return dielectric_presets(); }

  template <class LobeSet>
  void add_lobes(const Rgb& base, LobeSet& lobes) const {
    Dielectric<Rgb> lobe;
    lobe.tint = base;
    lobe.eta = eta;
    lobe.facets.alpha_x = lobe.facets.alpha_y = roughness;
    lobes.add(lobe);
  }
};

}  // namespace etendue
