// The wavelengths of a path, and the conversion of its radiance to linear sRGB.
//
// A path carries four wavelengths: the hero wavelength and three others at equal distances in the cumulative
// distribution, by rotation [Wilkie et al. 2014]. The density is proportional to D65 times the sum of the absolute
// matching functions of the three sRGB components. Spectral quantities of paths are relative to illuminant D65: white
// light is 1 at all wavelengths.
#pragma once
#include "spectrum/rgb.h"
#include "spectrum/sampled_spectrum.h"

namespace etendue {

struct Wavelengths {
  std::array<float, SampledSpectrum::kSize> nm{};
  std::array<float, SampledSpectrum::kSize> inverse_pdf{};  // of each wavelength, nm
  // Only the hero wavelength is left; the throughput at the others is 0.
  bool hero_only = false;

  // The hero wavelength in nm.
  float hero() const { return nm[0]; }
};

// The wavelengths of a uniform random number in [0, 1).
Wavelengths sample_wavelengths(float random);

// The density of each of the wavelengths, 1/nm; 0 outside the visible range.
float wavelength_pdf(float wavelength);

// An unbiased estimate of the linear sRGB value of a spectrum relative to D65.
Rgb rgb_estimate(const SampledSpectrum& radiance, const Wavelengths& wavelengths);

}  // namespace etendue
