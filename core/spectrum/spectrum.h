// Spectra of light: constant, black body, or tabulated.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "base/result.h"
#include "spectrum/observer.h"

namespace etendue {

// Spectral power by wavelength, in any unit.
class Spectrum {
 public:
  struct Sample {
    double wavelength = 0;  // nm
    double value = 0;
  };

  static Spectrum constant(double value);
  // Relative to 560 nm. The temperature lies in [kMinTemperature, kMaxTemperature] (blackbody.h).
  static Result<Spectrum> blackbody(double kelvin);
  // Linear between samples, 0 outside. An error unless there are at least two samples with increasing wavelengths and
  // finite values that are not negative.
  static Result<Spectrum> piecewise_linear(std::vector<Sample> samples);

  double operator()(double wavelength) const;
  // The first and the last wavelength of the samples; of all positive numbers without samples.
  std::pair<double, double> range() const;

  Xyz xyz() const;
  // Lumens per watt of the visible part, 380 to 780 nm; 0 for a black spectrum.
  double luminous_efficacy() const;
  // Linear sRGB with luminance 1. Components outside the gamut are negative; black for a black spectrum.
  std::array<double, 3> rgb() const;

 private:
  double constant_ = 0;
  double kelvin_ = 0;  // 0: not a black body
  std::vector<Sample> samples_;
};

// Reads rows of a wavelength in nm and a value, separated by a comma or by space. Empty rows, rows that start with '#',
// and one row of column names are skipped.
Result<Spectrum> read_spectrum(const std::string& path);

}  // namespace etendue
