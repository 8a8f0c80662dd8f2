// What facets lose by scattering light more than once, and a lobe that gives it back.
//
//   f = tint F_ms (1 - E(o)) (1 - E(i)) / (pi (1 - <E>)),   F_ms = <F>^2 <E> / (1 - <F> (1 - <E>))    Kulla, Conty 2017
//
// E is the albedo of the facets with F = 1, <E> and <F> are means over the hemisphere. Reciprocal; with F = 1 the whole
// surface gives back all light. E comes from a table by cos_o and, for facets of two widths, by the azimuth: made once
// for each pair of widths (5 ms of one width, 20 of two; Beckmann's 20 and 100), and kept for good (at most 2.3 kB).
#pragma once
#include <vector>

#include "bsdf/lobes/microfacet_reflection.h"

namespace etendue {

enum class MicrofacetDistribution : uint8_t { ggx, beckmann };

class MicrofacetEnergy {
 public:
  // Any thread may ask. Widths must not be below kSmoothAlpha.
  static const MicrofacetEnergy& of(MicrofacetDistribution kind, float alpha_x, float alpha_y);

  MicrofacetEnergy(MicrofacetDistribution kind, float alpha_x, float alpha_y);

  // 1 - E for a direction above the surface in the axes of the widths, and the mean of that, weighted by the cosine.
  float lost(const Vec3& w) const;
  float mean_lost() const { return mean_lost_; }

 private:
  static constexpr int kCosines = 33;  // nodes at cos = (k / 32)^2

  int azimuths_ = 1;  // nodes by the part of the tangential direction that is along the wider axis
  bool x_is_wider_ = true;
  std::vector<float> lost_;
  float mean_lost_ = 0;
};

template <class ColorType>
struct EnergyCompensation : OpaqueLobe<ColorType, EnergyCompensation<ColorType>, ScatterType::diffuse> {
  ColorType scale{0};  // tint F_ms / (pi (1 - <E>))
  const MicrofacetEnergy* energy = nullptr;
  Vec2 along{1, 0};

  static EnergyCompensation of(const MicrofacetEnergy& energy, const Vec2& along, const ColorType& tint,
                               const FresnelTerm<ColorType>& fresnel) {
    EnergyCompensation lobe;
    lobe.energy = &energy, lobe.along = along;
    const float lost = energy.mean_lost();
    const ColorType f = fresnel.mean();
    for (int k = 0; k < 3; ++k)
      lobe.scale[k] = lost > 0 ? tint[k] * sqr(f[k]) * (1 - lost) / ((1 - f[k] * lost) * kPi * lost) : 0;
    return lobe;
  }

  ColorType f(const Vec3& o, const Vec3& i) const { return scale * (lost(o) * lost(i)); }
  float density(const Vec3&, const Vec3& i) const { return cosine_hemisphere_pdf(i.z); }
  bool sample_direction(const Vec3&, const LobeRandom& random, Vec3& i) const {
    i = random.cosine_direction;
    return true;
  }
  float sampling_weight(const Vec3& wo) const {
    return average(scale) * kPi * energy->mean_lost() * lost(Vec3(wo.x, wo.y, std::abs(wo.z)));
  }
  float alpha() const { return 1; }

 private:
  float lost(const Vec3& w) const {
    return energy->lost(Vec3(along.x * w.x + along.y * w.y, along.x * w.y - along.y * w.x, w.z));
  }
};

}  // namespace etendue
