// The dipole diffusion profile: how far from its entry light leaves a scattering half-space.     [Jensen et al. 2001]
//
//   R(r) = alpha / (4 pi) sum over both poles of  z (sigma + 1 / d) exp(-sigma d) / d^2,   d^2 = r^2 + z^2
//   z_real = l,   z_virtual = l (1 + 4 K / 3),   sigma = sqrt(3 (1 - alpha)) / l,   K = (1 + F) / (1 - F)
//
// alpha is the reduced single-scattering albedo sigma_s' / (sigma_s' + sigma_a), l = 1 / (sigma_s' + sigma_a) the
// reduced mean free path in metres, sigma the effective transport coefficient, and F the diffuse reflectance of the
// boundary from inside. K is the mismatch: 1 for equal indices of refraction. The integral of R over the plane is the
// diffuse reflectance
//
//   A = alpha / 2 (1 + exp(-4/3 K s)) exp(-s),   s = sqrt(3 (1 - alpha))                                    [eq. 15]
//
// A material is given by A, because textures and people describe it; alpha follows by inversion.
#pragma once
#include <algorithm>
#include <cmath>

#include "bsdf/fresnel/fresnel_term.h"

namespace etendue {

// The hemispherical reflectance of a dielectric boundary for diffuse light from outside, and from inside. eta >= 1 is
// the index inside over that outside.
inline float diffuse_fresnel_outside(float eta) {
  return eta == 1 ? 0 : FresnelTerm<Rgb>{FresnelKind::dielectric, Rgb(eta), Rgb(0)}.mean().r;
}
inline float diffuse_fresnel_inside(float eta) { return 1 - (1 - diffuse_fresnel_outside(eta)) / sqr(eta); }

// K, from 1 for equal indices upwards.
inline float boundary_mismatch(float eta) {
  const float f = diffuse_fresnel_inside(eta);
  return (1 + f) / (1 - f);
}

class DipoleDiffusion {
 public:
  // `mean_free_path` is l in metres, positive; `albedo` is A in [0, 1].
  DipoleDiffusion(float mean_free_path, float albedo, float mismatch)
      : real_(mean_free_path), virtual_(mean_free_path * relative_depth(mismatch)) {
    const float s = absorption_exponent(albedo, mismatch);
    sigma_ = s / mean_free_path;
    real_share_ = 1 / (1 + std::exp(-s * (relative_depth(mismatch) - 1)));
    largest_radius_ = pole_radius(kNeglected, virtual_);  // that of the real pole is smaller
  }

  // A of a material with these coefficients, of any common unit. They may not both be 0. A depends on the root of the
  // absorption, so that 1 - alpha would lose its digits.
  static float albedo_of(float reduced_scattering, float absorption, float mismatch) {
    const float extinction = reduced_scattering + absorption;
    const float s = std::sqrt(3 * absorption / extinction);
    return 0.5f * reduced_scattering / extinction * (std::exp(-s) + std::exp(-s * relative_depth(mismatch)));
  }
  // The inverse: alpha.
  static float reduced_albedo(float albedo, float mismatch) {
    return 1 - sqr(absorption_exponent(albedo, mismatch)) / 3;
  }

  // Beyond this radius lies a share of at most 2e-4 of the light, which is neglected.
  float largest_radius() const { return largest_radius_; }

  // R / A, 1/m^2.
  float value(float r) const {
    return (real_share_ * pole_value(r, real_) + (1 - real_share_) * pole_value(r, virtual_)) / (2 * kPi);
  }
  // The radius within which a share `u` of the light of one pole leaves; the poles are selected by their shares.
  float sample_radius(float u) const {
    const bool is_real = u < real_share_;
    const float within = is_real ? u / real_share_ : (u - real_share_) / (1 - real_share_);
    return pole_radius(std::max(1 - within, 1e-12f), is_real ? real_ : virtual_);
  }

 private:
  static constexpr float kNeglected = 2e-4f;

  static float relative_depth(float mismatch) { return 1 + 4 * mismatch / 3; }

  // s for a given A: the root of a convex decreasing function in [0, sqrt(3)], to which Newton's method from 0 ascends.
  static float absorption_exponent(float albedo, float mismatch) {
    const double k = static_cast<double>(relative_depth(mismatch)), target = static_cast<double>(albedo);
    double s = 0;
    for (int i = 0; i < 20; ++i) {
      const double half = (1 - s * s / 3) / 2, real = std::exp(-s), image = std::exp(-k * s);
      const double excess = half * (real + image) - target;
      const double step = excess / (s / 3 * (real + image) + half * (real + k * image));
      if (!(step > 1e-9)) break;
      s += step;
    }
    return static_cast<float>(std::min(s, std::sqrt(3.0)));
  }

  // The density of one pole with the integral 2 pi over the plane.
  float pole_value(float r, float z) const {
    const float d2 = sqr(r) + sqr(z), d = std::sqrt(d2);
    return z * (sigma_ + 1 / d) * std::exp(-sigma_ * (d - z)) / d2;
  }
  // The radius beyond which the share z / d exp(-sigma (d - z)) of a pole's light leaves. Newton's method for
  // w = log(d / z), from above: w + sigma z (exp(w) - 1) = -log(beyond).
  float pole_radius(float beyond, float z) const {
    const float s = sigma_ * z, target = -std::log(beyond);
    float w = s > 0 ? std::min(target, std::log1p(target / s)) : target;
    for (int i = 0; i < 8; ++i) {
      const float excess = std::expm1(w), step = (w + s * excess - target) / (1 + s + s * excess);
      w -= step;
      if (!(step > 1e-6f * w)) break;
    }
    return z * safe_sqrt(std::expm1(2 * w));
  }

  float real_, virtual_;  // depths of the poles, m
  float sigma_;           // 1/m
  float real_share_;      // of the light
  float largest_radius_;
};

}  // namespace etendue
