// The measured index of refraction eta + i kappa of metals by wavelength.   [Johnson and Christy 1972; Rakic 1995]
#pragma once
#include <span>

#include "spectrum/rgb.h"

namespace etendue {

struct MetalSpectrum {
  // Interpolated linearly between samples; constant beyond the first and the last.
  struct Sample {
    float wavelength;  // nm
    float eta, kappa;
  };

  const char* name;  // of the preset with the same constants for RGB (optical_constants.h)
  std::span<const Sample> samples;

  float eta(float wavelength) const { return interpolated(wavelength, &Sample::eta); }
  float kappa(float wavelength) const { return interpolated(wavelength, &Sample::kappa); }

 private:
  float interpolated(float wavelength, float Sample::*member) const;
};

std::span<const MetalSpectrum> metal_spectra();

// The metal whose preset has these constants for RGB, or null.
const MetalSpectrum* find_metal_spectrum(const Rgb& eta, const Rgb& kappa);

}  // namespace etendue
