// Reflection by mirror microfacets in symmetric V-grooves.              [Cook and Torrance 1982; Lang, eq. 4.272-4.289]
//
//   f = tint F(<o, h>) G sum(W_k D_k(h)) / (4 cos_o cos_i)
//   G = min(1, 2 cos_h cos_o / <o, h>, 2 cos_h cos_i / <o, h>)
//
// Reciprocal. Sampling selects a distribution by its weight and samples a normal from it. The weight of a sample with
// one Beckmann distribution is tint F G <o, h> / (cos_h cos_o), which is not bounded at grazing angles.
#pragma once
#include "bsdf/fresnel/fresnel_term.h"
#include "bsdf/lobes/opaque_lobe.h"
#include "bsdf/microfacet/half_vector.h"
#include "bsdf/microfacet/slope_distribution.h"

namespace etendue {

template <class ColorType>
struct VGrooveMicrofacet : OpaqueLobe<ColorType, VGrooveMicrofacet<ColorType>> {
  static constexpr int kMaxDistributions = 3;

  ColorType tint{1};
  FresnelTerm<ColorType> fresnel;
  std::array<SlopeDistribution, kMaxDistributions> slopes;
  int count = 0;
  bool masked = true;  // false: G = 1

  void add(const SlopeDistribution& d) { slopes[static_cast<size_t>(count++)] = d; }

  ColorType f(const Vec3& o, const Vec3& i) const {
    const HalfVector half(o, i);
    return tint * fresnel(half.cosine) * (sum([&](const auto& s) { return s.d(half.h); }) * visibility(o, i, half));
  }
  float density(const Vec3& o, const Vec3& i) const {
    const HalfVector half(o, i);
    return half.cosine > 0 ? sum([&](const auto& s) { return s.density(half.h); }) / (4 * half.cosine * total_weight())
                           : 0;
  }
  bool sample_direction(const Vec3& o, const LobeRandom& random, Vec3& i) const {
    float choice = random.choice * total_weight();
    size_t k = 0;
    while (k + 1 < static_cast<size_t>(count) && choice >= slopes[k].weight) choice -= slopes[k++].weight;
    const Vec3 h = slopes[k].sample(random.u);
    i = reflect(o, h);
    return glm::dot(o, h) > 0;
  }
  float sampling_weight(const Vec3& wo) const { return average(tint * fresnel(std::abs(wo.z))) * total_weight(); }
  float alpha() const {
    float least = 1;
    for (size_t k = 0; k < static_cast<size_t>(count); ++k) least = std::min(least, slopes[k].m);
    return least;
  }

 private:
  // G / (4 cos_o cos_i), without dividing by the smaller cosine where G contains it.
  float visibility(const Vec3& o, const Vec3& i, const HalfVector& half) const {
    const float low = std::min(o.z, i.z), high = std::max(o.z, i.z);
    const float unmasked = 1 / low;
    return (masked ? std::min(unmasked, 2 * half.h.z / half.cosine) : unmasked) / (4 * high);
  }
  template <class F>
  float sum(F&& of_distribution) const {
    float total = 0;
    for (size_t k = 0; k < static_cast<size_t>(count); ++k) total += slopes[k].weight * of_distribution(slopes[k]);
    return total;
  }
  float total_weight() const {
    return sum([](const auto&) { return 1.0f; });
  }
};

}  // namespace etendue
