#include "bsdf/fresnel/thin_film.h"

#include <algorithm>
#include <cmath>

namespace etendue {
namespace {

// Reflectance at normal incidence between two dielectrics.
float f0_between(float n1, float n2) { return sqr((n2 - n1) / (n2 + n1)); }

// The index of refraction of a base with reflectance f0 in air. A metal is treated as a dielectric of a high index.
float ior_of(float f0) {
  const float root = std::sqrt(std::clamp(f0, 0.0f, 0.9999f));
  return (1 + root) / (1 - root);
}

float schlick(float f0, float cosine) { return f0 + (1 - f0) * schlick_weight(cosine); }

// The Fourier transform of one Gaussian of the observer's sensitivity curves.
float fourier_gaussian(float value, float position, float variance, float phase, float shift) {
  return value * std::sqrt(2 * kPi * variance) * std::cos(position * phase + shift) * std::exp(-sqr(phase) * variance);
}

// The linear sRGB response to a cosine over all wavelengths, for a difference of optical path lengths in nanometres and
// a phase shift for each colour component.
Rgb sensitivity(float path, const Rgb& shift) {
  const float phase = 2 * kPi * path * 1e-9f;
  constexpr float kNorm = 1.0685e-7f;
  const float x = (fourier_gaussian(5.4856e-13f, 1.6810e6f, 4.3278e9f, phase, shift.r) +
                   fourier_gaussian(9.7470e-14f, 2.2399e6f, 4.5282e9f, phase, shift.r)) /
                  kNorm;
  const float y = fourier_gaussian(4.4201e-13f, 1.7953e6f, 9.3046e9f, phase, shift.g) / kNorm;
  const float z = fourier_gaussian(5.2481e-13f, 2.2084e6f, 6.6121e9f, phase, shift.b) / kNorm;
  return {3.2404542f * x - 1.5371385f * y - 0.4985314f * z, -0.9692660f * x + 1.8760108f * y + 0.0415560f * z,
          0.0556434f * x - 0.2040259f * y + 1.0572252f * z};
}

}  // namespace

Rgb ThinFilm::reflectance(float cosine, const Rgb& base_f0) const {
  const float inner = safe_sqrt(1 - (1 - sqr(cosine)) / sqr(ior));
  const float r12 = schlick(f0_between(1, ior), cosine), t121 = 1 - r12;
  const float path = 2 * ior * thickness * inner;

  Rgb terms, phase, amplitude, f;  // amplitude: sqrt(R12 R23)
  for (int c = 0; c < 3; ++c) {
    const float base = ior_of(base_f0[c]);
    const float r23 = schlick(f0_between(ior, base), inner);
    const float r123 = std::min(r12 * r23, 0.9999f);
    const float rs = sqr(t121) * r23 / (1 - r123);
    // Internal reflection at the boundary to air shifts the phase by pi, because the film is denser than air.
    // Reflection at the base shifts it by pi if the base has the lower index.
    phase[c] = kPi + (base < ior ? kPi : 0);
    amplitude[c] = std::sqrt(r123);
    f[c] = r12 + rs;
    terms[c] = rs - t121;
  }
  for (int m = 1; m <= 2; ++m) {
    terms *= amplitude;
    f += terms * sensitivity(static_cast<float>(m) * path, phase * static_cast<float>(m)) * 2.0f;
  }
  for (int c = 0; c < 3; ++c) f[c] = std::clamp(f[c], 0.0f, 1.0f);
  return f;
}

}  // namespace etendue
