// Reflection by mirror microfacets with Smith masking.                          [Torrance and Sparrow 1967; Heitz 2014]
//
//   f = tint F(<o, h>) D(h) G2(o, i) / (4 cos_o cos_i),     G2 = 1 / (1 + Lambda(o) + Lambda(i))
//
// Reciprocal. Sampled by the normals visible from o; the weight of a sample is tint F G2 / G1. Light that microfacets
// scatter more than once is lost unless EnergyCompensation (energy_compensation.h) restores it.
#pragma once
#include "bsdf/fresnel/fresnel_term.h"
#include "bsdf/lobes/opaque_lobe.h"
#include "bsdf/microfacet/beckmann.h"
#include "bsdf/microfacet/half_vector.h"

namespace etendue {

// G2 / (4 cos_o cos_i), finite at grazing angles.
template <class Facets>
float facet_visibility(const Facets& facets, const Vec3& o, const Vec3& i) {
  const float crossed = i.z * facets.projected_lambda(o) + o.z * facets.projected_lambda(i);
  return 0.25f / (o.z * i.z + crossed);
}

template <class ColorType, class FacetsType>
struct MicrofacetReflection : OpaqueLobe<ColorType, MicrofacetReflection<ColorType, FacetsType>> {
  ColorType tint{1};
  FresnelTerm<ColorType> fresnel;
  FacetsType facets;

  ColorType f(const Vec3& o, const Vec3& i) const {
    const HalfVector half(o, i);
    return tint * fresnel(half.cosine) * (facets.d(half.h) * facet_visibility(facets, o, i));
  }
  float density(const Vec3& o, const Vec3& i) const {
    return facets.d(HalfVector(o, i).h) / (4 * (o.z + facets.projected_lambda(o)));
  }
  bool sample_direction(const Vec3& o, const LobeRandom& random, Vec3& i) const {
    i = reflect(o, facets.sample_visible(o, random.u));
    return true;
  }
  float sampling_weight(const Vec3& wo) const { return average(tint * fresnel(std::abs(wo.z))); }
  float alpha() const { return std::max(facets.alpha_x, facets.alpha_y); }
};

}  // namespace etendue
