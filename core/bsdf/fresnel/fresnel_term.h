// Fresnel reflectance of a microfacet for each colour component: exact or approximate.
//
// Unpolarised light from vacuum onto a medium of index eta + i kappa. The cosine is that between the direction and the
// normal of the microfacet, not of the surface [Lang, eq. 4.289, corrected].
//
//   one          1, a perfect mirror
//   dielectric   exact; kappa is ignored                                              [Lang, eq. 4.67, 4.68, 4.72]
//   conductor    exact, for the complex index                                       [Born and Wolf 1999, sec. 14.2]
//   approximate  conductor, exact at 0 and 90 degrees and in between at most 0.0054 too high (gold of table 4.2, at 69
//                degrees). The two terms are reflectances and are not squared again  [Lang, eq. 4.69-4.72, corrected]
//   schlick      F0 + (1 - F0)(1 - cos)^5 with the exact F0. At most 0.0357 off for glass of index 1.5, at 85 degrees.
//                From the denser side it uses the refracted cosine, and is 1 beyond the critical angle
//                                                                   [Schlick 1993; Lang, eq. 4.75, corrected]
#pragma once
#include <array>
#include <cmath>
#include <utility>

#include "base/parameter.h"
#include "bsdf/bsdf_model_info.h"
#include "bsdf/fresnel/fresnel.h"

namespace etendue {

enum class FresnelKind : uint8_t { one, dielectric, conductor, approximate, schlick };

// The exact reflectance of a conductor.
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

// The approximation of [Lang, eq. 4.69-4.70].
inline float fresnel_conductor_approximate(float cosine, float eta, float kappa) {
  const float squares = sqr(eta) + sqr(kappa), twice = 2 * eta * cosine;
  const float parallel = (squares * sqr(cosine) - twice + 1) / (squares * sqr(cosine) + twice + 1);
  const float perpendicular = (squares - twice + sqr(cosine)) / (squares + twice + sqr(cosine));
  return 0.5f * (parallel + perpendicular);
}

// Reflectance at normal incidence.
inline float fresnel_at_normal(float eta, float kappa) {
  return (sqr(eta - 1) + sqr(kappa)) / (sqr(eta + 1) + sqr(kappa));
}

// Schlick's approximation, extended to incidence from the denser side (eta < 1).
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
    for (int k = 0; k < 3; ++k) f[k] = component(cosine, eta[k], kappa[k]);
    return f;
  }

  // The term of one colour component with index n + i k; `kind` is not `one`.
  float component(float cosine, float n, float k) const {
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

  // The mean over the hemisphere, weighted by the cosine. Gauss-Legendre quadrature in the cosine; error below 1e-6.
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
};

// The parameters of a model with a selectable Fresnel term. The default is measured gold (optical_constants.h).
struct FresnelParameters {
  Choice<FresnelKind> kind{"fresnel", "Fresnel", FresnelKind::conductor,
                           "Fresnel term of the microfacets: exact, approximate, or 1 (perfect mirror)"};
  Triple eta{"eta",
             "IOR \u03b7",
             Vec3(0.01000f, 0.49770f, 1.47453f),
             {0.01f, 10},
             "Index of refraction relative to vacuum, real part"};
  Triple kappa{"kappa",
               "Extinction k",
               Vec3(5.00000f, 2.25729f, 1.77625f),
               {0, 20},
               "Imaginary part of the index of refraction; 0 for dielectrics"};

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
