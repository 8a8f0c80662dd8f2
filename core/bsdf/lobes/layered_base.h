// The light that a specular layer leaves to the diffuse base below it.
//
//   glTF                1 - F_d(cos)                                                  [glTF 2.0, appendix B]
//   energy conserving   (1 - E(o)) (1 - E(i)) / (1 - <E>)       [Kelemen and Szirmay-Kalos 2001; Kulla and Conty 2017]
//
// F_d is the Fresnel term of the dielectric layer; each lobe chooses its angle. E is the directional albedo of the
// layer, <E> its cosine-weighted mean. With the first form a white base and the layer together reflect up to 1.9 times
// the light. With the second they reflect all light but for what the table overestimates (ggx_albedo.h). Anisotropic
// microfacets are represented by their smaller roughness: the albedo reaches 1.04 at 89 degrees. For a thin film, E is
// estimated from the Fresnel term at one angle: the albedo reaches 1.01, and 1.14 for a film of index 1.
#pragma once
#include <cstdint>

#include "bsdf/microfacet/ggx.h"
#include "bsdf/microfacet/ggx_albedo.h"

namespace etendue {

enum class Layering : uint8_t { gltf, energy_conserving };

// 1 - E. Fresnel is SchlickFresnel or FilmFresnel.
template <class Fresnel>
float layer_transmittance(const Fresnel& layer, const Ggx& facets, const Vec3& w) {
  const GgxAlbedo e = GgxAlbedoRow(std::min(facets.alpha_x, facets.alpha_y)).at(std::abs(w.z));
  return std::max(0.0f, 1 - layer.layer_albedo(e));
}

// 1 / (1 - <E>). The error of the table is large in comparison with 1 - <E> below 0.05; it is at least that.
template <class Fresnel>
float layer_normalization(const Fresnel& layer, const Ggx& facets) {
  return 1 / std::max(0.05f, 1 - layer.mean_layer_albedo(std::min(facets.alpha_x, facets.alpha_y)));
}

// The part of the light from wi that reaches the base and leaves to wo. The directions may lie on either side.
template <class Fresnel>
float coupled_transmittance(const Fresnel& layer, const Ggx& facets, float normalization, const Vec3& wo,
                            const Vec3& wi) {
  return layer_transmittance(layer, facets, wo) * layer_transmittance(layer, facets, wi) * normalization;
}

}  // namespace etendue
