// Coefficients of media by wavelength: measured spectra by name, or from a file.
#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/parameter.h"
#include "spectrum/named_spectra.h"
#include "spectrum/rgb.h"
#include "spectrum/spectrum.h"
#include "spectrum/wavelength_table.h"

namespace etendue {

// A coefficient in 1/m, linear between whole nanometres. Outside of the table of the spectrum it has the value at the
// closer end.
class CoefficientSpectrum {
 public:
  explicit CoefficientSpectrum(const Spectrum& spectrum);

  SampledSpectrum at(const Wavelengths& wavelengths) const { return values_.at(wavelengths); }
  // In nm.
  float at(float wavelength) const { return values_.at(wavelength); }

  // The coefficients that RGB rendering uses.
  //
  //   scattering  the linear sRGB value of the spectrum in illuminant D65, so that thin media have the same colour
  //   absorption  -ln(T) / d, where T is the linear sRGB value of the transmittance of d metres, and d is one over the
  //               largest component of the result
  //
  // Components outside the gamut are 0 for scattering; their transmittance is 0.0001 or 1 for absorption.
  const Rgb& rgb_of_scattering() const { return rgb_of_scattering_; }
  const Rgb& rgb_of_absorption() const { return rgb_of_absorption_; }

 private:
  WavelengthTable values_;
  Rgb rgb_of_scattering_{0}, rgb_of_absorption_{0};
};

// A measured coefficient with a name.
enum class Coefficient : uint8_t { scattering, absorption };
struct NamedCoefficient {
  const char *name, *label, *source;
  Coefficient coefficient;
  Spectrum (*make)();  // 1/m
};
const std::vector<NamedCoefficient>& named_coefficients();

// Stands for a coefficient that is given as RGB.
inline constexpr const char* kNoCoefficientSpectrum = "none";

// None if the coefficient is given as RGB.
using CoefficientSpectrumRef = NamedSpectrum<CoefficientSpectrum>;

// kNoCoefficientSpectrum, the name of a measured coefficient, points such as "400:0.2 700:1"
// (spectrum/spectrum_points.h), or the path of a file (spectrum/spectrum.h).
Result<CoefficientSpectrumRef> find_coefficient_spectrum(Coefficient coefficient, std::string_view name);
// Whether the name is that of a file.
bool names_coefficient_file(std::string_view name);

// The parameter of a medium that names the spectrum of one of its coefficients.
Text coefficient_spectrum_parameter(Coefficient coefficient, const CoefficientSpectrumRef& value);

}  // namespace etendue
