// Smooth spectra for RGB colours.                                                              [Jakob and Hanika 2019]
//
//   S(lambda) = 1/2 + p / (2 sqrt(1 + p^2)),       p = c0 t^2 + c1 t + c2,       t = (lambda - 380 nm) / 400 nm
//
// lies between 0 and 1 and has the given linear sRGB value under illuminant D65. The coefficients are tabulated for
// the largest component and the ratios of the other two, and interpolated. Colours without chroma have constant
// spectra. The table is part of the program (uplift_table.h).
#pragma once
#include "spectrum/rgb.h"
#include "spectrum/wavelengths.h"

namespace etendue {

// The coefficients c0, c1, c2 of a colour with components from 0 to 1.
struct SigmoidSpectrum {
  float c0 = 0, c1 = 0, c2 = 0;

  static SigmoidSpectrum of(const Rgb& color);
  float operator()(float wavelength) const;
};

// The spectrum of an RGB colour in a form that is prepared once and evaluated for many paths.
class RgbSpectrum {
 public:
  RgbSpectrum() = default;  // black
  // The same spectra as those of the functions below.
  static RgbSpectrum reflectance(const Rgb& color);
  static RgbSpectrum scaled(const Rgb& color);
  static RgbSpectrum emission(const Rgb& color);

  SampledSpectrum at(const Wavelengths& wavelengths) const;

 private:
  static RgbSpectrum relative_to(float scale, const Rgb& color);

  float scale_ = 0;  // the value of a constant spectrum, or the factor of `shape_`
  bool constant_ = true;
  SigmoidSpectrum shape_;
};

// The spectrum of a reflectance or transmittance; at most 1. Components are clamped to [0, 1].
SampledSpectrum uplift_reflectance(const Rgb& color, const Wavelengths& wavelengths);

// The spectrum of values with any bound, such as those of BSDFs: the largest component times the spectrum of a
// reflectance. No wavelength exceeds the largest component.
SampledSpectrum uplift_scaled(const Rgb& color, const Wavelengths& wavelengths);

// The spectrum of emitted light relative to D65, so that white light is constant. Its maximum is at most twice the
// largest component, which keeps saturated lights smooth.
SampledSpectrum uplift_emission(const Rgb& color, const Wavelengths& wavelengths);

}  // namespace etendue
