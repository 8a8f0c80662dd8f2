// Fresnel reflectance of a facet by band of colour: exact, or one of the approximations whose error can be seen so.
//
// Unpolarised light from vacuum onto an index eta + i kappa.          thesis 4.1.3, items 22-26, errata E3, E5, E20
//
//   dielectric     (4.83)-(4.85) squared; kappa is not looked at
//   conductor      the same for the complex index (Born and Wolf, 14.2)
//   approximate    (4.87), (4.88), which are intensities already and are not squared again (E3): exact at 0 and 90
//                  degrees, between them at most 0.0054 too high (gold of table 4.2, at 69 degrees)
//   schlick        F0 + (1 - F0)(1 - cos)^5, F0 exact. Against glass of 1.5 at most 0.0357 off, at 85 degrees. From the
//                  denser side with the refracted cosine, and 1 beyond the critical angle (E5)
//
// "One" is a perfect mirror at every facet. The cosine is that to the facet's normal, not to the surface's (E20).
#pragma once
#include <array>
#include <cmath>
#include <utility>

#include "base/parameter.h"
#include "bsdf/bsdf_model_info.h"
#include "bsdf/fresnel/fresnel.h"

namespace etendue {

enum class FresnelKind : uint8_t { one, dielectric, conductor, approximate, schlick };

inline float fresnel_conductor(float cosine, float eta, float kappa) {
  const float cos2 = sqr(cosine), sin2 = std::max(0.0f, 1 - cos2);
  const float real = sqr(eta) - sqr(kappa) - sin2;
  const float modulus = std::sqrt(sqr(real) + 4 * sqr(eta * kappa));
  const float twice_cos = 2 * cosine * safe_sqrt(0.5f * (modulus + real));
  const float perpendicular = (modulus + cos2 - twice_cos) / std::max(modulus + cos2 + twice_cos, 1e-30f);
  const float a = modulus * cos2 + sqr(sin2), b = twice_cos * sin2;
  const float parallel = perpendicular * (a - b) / std::max(a + b, 1e-30f);
  return 0.5f * (parallel + perpendicular);
}

inline float fresnel_conductor_approximate(float cosine, float eta, float kappa) {
  const float squares = sqr(eta) + sqr(kappa), twice = 2 * eta * cosine;
  const float parallel = (squares * sqr(cosine) - twice + 1) / (squares * sqr(cosine) + twice + 1);
  const float perpendicular = (squares - twice + sqr(cosine)) / (squares + twice + sqr(cosine));
  return 0.5f * (parallel + perpendicular);
}

inline float fresnel_at_normal(float eta, float kappa) {
  return (sqr(eta - 1) + sqr(kappa)) / (sqr(eta + 1) + sqr(kappa));
}

inline float fresnel_schlick(float cosine, float eta, float kappa) {
  const float f0 = fresnel_at_normal(eta, kappa);
  if (eta < 1 && kappa == 0) {
    const float sin2_t = (1 - sqr(cosine)) / sqr(eta);
    if (sin2_t >= 1) return 1;
    cosine = safe_sqrt(1 - sin2_t);
  }
  return f0 + (1 - f0) * schlick_weight(cosine);
}

template <class Color>
struct FresnelTerm {
  FresnelKind kind = FresnelKind::one;
  Color eta{1.5f}, kappa{0};

  Color operator()(float cosine) const {
    Color f(1);
    if (kind == FresnelKind::one) return f;
    for (int k = 0; k < 3; ++k) f[k] = of_band(cosine, eta[k], kappa[k]);
    return f;
  }

  // The mean over the hemisphere, weighted by the cosine: Gauss points in the cosine, to 1e-6.
  Color mean() const {
    static constexpr std::array<std::pair<float, float>, 5> kGauss{{{0.0130467357f, 0.0333356722f},
                                                                    {0.0674683167f, 0.0747256746f},
                                                                    {0.1602952159f, 0.1095431813f},
                                                                    {0.2833023029f, 0.1346333597f},
                                                                    {0.4255628305f, 0.1477621124f}}};
    Color sum(0);
    for (const auto& [x, weight] : kGauss) sum += ((*this)(x)*x + (*this)(1 - x) * (1 - x)) * (2 * weight);
    return sum;
  }

 private:
  float of_band(float cosine, float n, float k) const {
    float refracted;
    switch (kind) {
      case FresnelKind::dielectric:
        return fresnel_dielectric(cosine, n, refracted);
      case FresnelKind::conductor:
        return fresnel_conductor(cosine, n, k);
      case FresnelKind::approximate:
        return fresnel_conductor_approximate(cosine, n, k);
      default:
        return fresnel_schlick(cosine, n, k);
    }
  }
};

// The knobs of the models that let one choose.
struct FresnelParameters {
  Choice<FresnelKind> kind{
      "fresnel", "Fresnel", FresnelKind::conductor,
      "Exact for a dielectric or for a metal, the thesis's approximation for metals, Schlick's, or "
      "1: a perfect mirror"};
  Triple eta{"eta",
             "Index",
             Vec3(0.10475f, 0.49154f, 1.47733f),
             {0.01f, 10},
             "Index of refraction (real part) by band, over that of the vacuum"};
  Triple kappa{"kappa",
               "Extinction",
               Vec3(3.51907f, 2.32971f, 1.81014f),
               {0, 20},
               "Imaginary part of the index by band; 0 for a dielectric"};

  auto parameters() { return std::tie(kind, eta, kappa); }
  FresnelTerm<Rgb> term() const { return {kind, rgb_of(eta), rgb_of(kappa)}; }
};

}  // namespace etendue

template <>
struct etendue::Options<etendue::FresnelKind> {
  static constexpr std::array<etendue::Option, 5> kOptions{{{"one", "1 (perfect mirror)"},
                                                            {"dielectric", "Dielectric, exact"},
                                                            {"conductor", "Conductor, exact"},
                                                            {"approximate", "Conductor, approximate"},
                                                            {"schlick", "Schlick"}}};
};
