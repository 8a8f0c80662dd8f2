// A pane of clear or tinted glass too thin to shift a ray: two interfaces, and all reflections between them.
//
//   R = F + (1 - F)^2 F t^2 / (1 - F^2 t^2),   T = (1 - F)^2 t / (1 - F^2 t^2)         by polarisation; item 39 [D]
//
// F is the reflectance of one interface, t what is left of light that crosses the glass once: tint^(1 / cos_t), Beer's
// law for a tint given at normal incidence. Clear glass at normal incidence lets (1 - F) / (1 + F) through, 0.923077
// for an index of 1.5. Polarisations do not mix between parallel interfaces, so the mean is taken at the end. Without
// interference. Two deltas; reciprocal; R + T = 1 where the tint is white.
#pragma once
#include <cmath>

#include "bsdf/lobes/delta_lobe.h"

namespace etendue {

template <class Color>
struct ThinDielectric : DeltaLobe<Color> {
  Color tint{1};
  float eta = 1.5f;

  float sampling_weight(const Vec3&) const { return 1; }

  struct Parts {
    Color reflected{0}, passed{0};
    float reflect_share() const {
      const float r = average(reflected), t = average(passed);
      return t > 0 ? r / (r + t) : 1;
    }
  };
  Parts parts(float cosine) const {
    Parts sum;
    const float sin2_t = (1 - sqr(cosine)) / sqr(eta);
    if (sin2_t >= 1) return {Color(1), Color(0)};
    const float cos_t = std::sqrt(1 - sin2_t);
    const float parallel = (eta * cosine - cos_t) / (eta * cosine + cos_t);
    const float perpendicular = (cosine - eta * cos_t) / (cosine + eta * cos_t);
    for (int k = 0; k < 3; ++k) {
      const float t = tint[k] > 0 ? std::pow(tint[k], 1 / cos_t) : 0.0f;
      for (const float f : {sqr(parallel), sqr(perpendicular)}) {
        // At 90 degrees f is one, and nothing passes.
        const float left = 1 - sqr(f * t), passed = left > 0 ? sqr(1 - f) * t / left : 0;
        sum.reflected[k] += 0.5f * (f + passed * f * t);
        sum.passed[k] += 0.5f * passed;
      }
    }
    return sum;
  }

  bool sample(const Vec3& wo, const LobeRandom& random, TransportMode, LobeSample<Color>& s) const {
    const Parts both = parts(std::abs(wo.z));
    const float share = both.reflect_share();
    s.transmitted = random.choice >= share;
    s.wi = s.transmitted ? -wo : this->mirrored(wo);
    s.weight = s.transmitted ? both.passed / (1 - share) : both.reflected / share;
    s.type = ScatterType::specular;
    s.delta = true;
    return true;
  }
  void add_deltas(const Vec3& wo, TransportMode, DeltaSet<Color>& deltas) const {
    const Parts both = parts(std::abs(wo.z));
    const float share = both.reflect_share();
    deltas.add_reflection(this->mirrored(wo), both.reflected, share);
    if (share < 1) deltas.add_transmission(-wo, both.passed, 1, 1 - share);
  }
};

}  // namespace etendue
