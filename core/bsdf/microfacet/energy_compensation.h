// A lobe that restores the energy which microfacets lose by multiple scattering.               [Kulla and Conty 2017]
//
//   f = tint F_ms (1 - E(o)) (1 - E(i)) / (pi (1 - <E>)),   F_ms = <F>^2 <E> / (1 - <F> (1 - <E>))
//
// E is the directional albedo of the microfacets with F = 1; <E> and <F> are cosine-weighted means over the hemisphere.
// Reciprocal. With F = 1 the microfacets and this lobe together reflect all light. Sampled by the cosine.
// E is tabulated by cos_o and, for anisotropic microfacets, by azimuth. A table is computed once per pair of
// roughnesses (GGX: 5 ms if isotropic, else 20 ms; Beckmann: 20 and 100 ms) and kept until the program ends (at
// most 2.3 kB).
#pragma once
#include <vector>

#include "bsdf/lobes/microfacet_reflection.h"

namespace etendue {

enum class MicrofacetDistribution : uint8_t { ggx, beckmann };

class MicrofacetEnergy {
 public:
  // The shared table for a pair of roughnesses, which must be at least kSmoothAlpha. Thread-safe.
  static const MicrofacetEnergy& of(MicrofacetDistribution kind, float alpha_x, float alpha_y);

  MicrofacetEnergy(MicrofacetDistribution kind, float alpha_x, float alpha_y);

  // 1 - E for a direction above the surface, in the frame whose x axis is the axis of alpha_x.
  float missing_energy(const Vec3& w) const;
  // 1 - <E>.
  float mean_missing_energy() const { return mean_missing_; }

 private:
  static constexpr int kCosines = 33;  // nodes at cos = (k / 32)^2

  int azimuths_ = 1;  // nodes in |cos| of the angle between the tangential direction and the rougher axis
  bool x_is_rougher_ = true;
  std::vector<float> missing_;  // 1 - E, by azimuth and cosine
  float mean_missing_ = 0;
};

template <class ColorType>
struct EnergyCompensation : OpaqueLobe<ColorType, EnergyCompensation<ColorType>, ScatterType::diffuse> {
  ColorType scale{0};  // tint F_ms / (pi (1 - <E>))
  const MicrofacetEnergy* energy = nullptr;
  Vec2 along{1, 0};

  static EnergyCompensation of(const MicrofacetEnergy& energy, const Vec2& along, const ColorType& tint,
                               const FresnelTerm<ColorType>& fresnel) {
    EnergyCompensation lobe;
    lobe.energy = &energy;
    lobe.along = along;
    const float missing = energy.mean_missing_energy();
    const ColorType f = fresnel.mean();
    for (int k = 0; k < 3; ++k)
      lobe.scale[k] = missing > 0 ? tint[k] * sqr(f[k]) * (1 - missing) / ((1 - f[k] * missing) * kPi * missing) : 0;
    return lobe;
  }

  ColorType f(const Vec3& o, const Vec3& i) const { return scale * (missing(o) * missing(i)); }
  float density(const Vec3&, const Vec3& i) const { return cosine_hemisphere_pdf(i.z); }
  bool sample_direction(const Vec3&, const LobeRandom& random, Vec3& i) const {
    i = random.cosine_direction;
    return true;
  }
  float sampling_weight(const Vec3& wo) const {
    return average(scale) * kPi * energy->mean_missing_energy() * missing(Vec3(wo.x, wo.y, std::abs(wo.z)));
  }
  float alpha() const { return 1; }

 private:
  float missing(const Vec3& w) const {
    return energy->missing_energy(Vec3(along.x * w.x + along.y * w.y, along.x * w.y - along.y * w.x, w.z));
  }
};

}  // namespace etendue
