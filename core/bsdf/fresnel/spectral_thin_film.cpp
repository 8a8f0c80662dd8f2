#include "bsdf/fresnel/spectral_thin_film.h"

#include <algorithm>
#include <cmath>

namespace etendue {

SampledSpectrum SpectralThinFilm::reflectance(float cosine, const SampledSpectrum& base_f0) const {
  const float inner = safe_sqrt(1 - (1 - sqr(cosine)) / sqr(ior));
  const auto schlick = [](float f0, float c) { return f0 + (1 - f0) * schlick_weight(c); };
  const float r12 = schlick(f0_from_ior(ior), cosine), t121 = 1 - r12;
  const float path = 2 * ior * thickness * inner;  // optical path difference, nm

  SampledSpectrum result;
  for (int i = 0; i < SampledSpectrum::kSize; ++i) {
    // The index of the base; a metal is treated as a dielectric of a high index.
    const float root = std::sqrt(std::clamp(base_f0[i], 0.0f, 0.9999f)), base = (1 + root) / (1 - root);
    const float r23 = schlick(sqr((base - ior) / (base + ior)), inner);
    const float r123 = std::min(r12 * r23, 0.9999f), q = std::sqrt(r123);
    const float rs = sqr(t121) * r23 / (1 - r123);
    const float phase = 2 * kPi * path / wavelengths->nm[static_cast<size_t>(i)] + kPi + (base < ior ? kPi : 0);
    // The sum over m > 0 of q^m cos(m phase).
    const float c = std::cos(phase), sum = (q * c - r123) / (1 - 2 * q * c + r123);
    result[i] = std::clamp(r12 + rs + 2 * (rs - t121) * sum, 0.0f, 1.0f);
  }
  return result;
}

}  // namespace etendue
