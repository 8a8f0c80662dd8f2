// A pane of clear or tinted glass, too thin to displace a ray: two interfaces and all reflections between them.
//
//   R = F + (1 - F)^2 F t^2 / (1 - F^2 t^2),   T = (1 - F)^2 t / (1 - F^2 t^2),     averaged over both polarisations
//
// F is the reflectance of one interface and t the transmittance of one crossing of the glass, tint^(1 / cos_t) by
// Beer's law; the tint is that at normal incidence. Clear glass transmits (1 - F) / (1 + F) at normal incidence,
// 0.923077 for an index of 1.5. Parallel interfaces do not mix the polarisations, so the mean is taken last. No
// interference. Two deltas. Reciprocal; R + T = 1 for a white tint.
#pragma once
#include <cmath>

#include "bsdf/lobes/delta_lobe.h"

namespace etendue {

template <class Color>
struct ThinDielectric : DeltaLobe<Color> {
  Color tint{1};
  float eta = 1.5f;

  float sampling_weight(const Vec3&) const { return 1; }

  struct Coefficients {
    Color reflected{0}, transmitted{0};  // R and T
    float reflection_probability() const {
      const float r = average(reflected), t = average(transmitted);
      return t > 0 ? r / (r + t) : 1;
    }
  };
  Coefficients coefficients(float cosine) const {
    Coefficients sum;
    const float sin2_t = (1 - sqr(cosine)) / sqr(eta);
    if (sin2_t >= 1) return {Color(1), Color(0)};
    const float cos_t = std::sqrt(1 - sin2_t);
    const float parallel = (eta * cosine - cos_t) / (eta * cosine + cos_t);
    const float perpendicular = (cosine - eta * cos_t) / (cosine + eta * cos_t);
    for (int k = 0; k < 3; ++k) {
      const float t = tint[k] > 0 ? std::pow(tint[k], 1 / cos_t) : 0.0f;
      for (const float f : {sqr(parallel), sqr(perpendicular)}) {
        // At 90 degrees f is 1 and nothing is transmitted.
        const float remaining = 1 - sqr(f * t), transmitted = remaining > 0 ? sqr(1 - f) * t / remaining : 0;
        sum.reflected[k] += 0.5f * (f + transmitted * f * t);
        sum.transmitted[k] += 0.5f * transmitted;
      }
    }
    return sum;
  }

  bool sample(const Vec3& wo, const LobeRandom& random, TransportMode, LobeSample<Color>& s) const {
    const Coefficients both = coefficients(std::abs(wo.z));
    const float reflection = both.reflection_probability();
    s.transmitted = random.choice >= reflection;
    s.wi = s.transmitted ? -wo : this->mirrored(wo);
    s.weight = s.transmitted ? both.transmitted / (1 - reflection) : both.reflected / reflection;
    s.type = ScatterType::specular;
    s.delta = true;
    return true;
  }
  void add_deltas(const Vec3& wo, TransportMode, DeltaSet<Color>& deltas) const {
    const Coefficients both = coefficients(std::abs(wo.z));
    const float reflection = both.reflection_probability();
    deltas.add_reflection(this->mirrored(wo), both.reflected, reflection);
    if (reflection < 1) deltas.add_transmission(-wo, both.transmitted, 1, 1 - reflection);
  }
};

}  // namespace etendue
