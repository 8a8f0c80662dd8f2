// Coefficients of media at the wavelengths of a path: measured, or derived from RGB coefficients.
//
// Spectra of RGB coefficients are smooth, bounded and not negative. RGB coefficients without colour give constant
// spectra.
//
//   scattering  sigma_s(lambda) = m S(lambda), where S has the RGB value sigma_s / m and m is twice the largest
//               component: the RGB value of the spectrum is the RGB coefficient, so that thin media show the same colour
//   absorption  sigma_a(lambda) = -ln S(lambda) / d, where S has the RGB value exp(-sigma_a d) and d is one over the
//               largest component: the transmittance of d metres has the RGB value that Beer's law gives for RGB
//
// S is the smooth reflectance spectrum of [Jakob and Hanika 2019]. At other thicknesses the colours of RGB and spectral
// rendering differ, because Beer's law holds for each wavelength.
#pragma once
#include <memory>

#include "medium/coefficient_spectrum.h"
#include "medium/medium_coefficients.h"

namespace etendue {

// A scattering coefficient by wavelength, 1/m.
class ScatteringSpectrum {
 public:
  ScatteringSpectrum() = default;
  explicit ScatteringSpectrum(const Rgb& scattering) : rgb_(RgbSpectrum::emission(scattering)) {}
  explicit ScatteringSpectrum(std::shared_ptr<const CoefficientSpectrum> measured) : measured_(std::move(measured)) {}

  SampledSpectrum at(const Wavelengths& wavelengths) const {
    return measured_ ? measured_->at(wavelengths) : rgb_.at(wavelengths);
  }

 private:
  RgbSpectrum rgb_ = RgbSpectrum::emission(Rgb(0));
  std::shared_ptr<const CoefficientSpectrum> measured_;  // null: `rgb_` holds
};

// An absorption coefficient by wavelength, 1/m.
class AbsorptionSpectrum {
 public:
  AbsorptionSpectrum() = default;
  // The sum of an RGB coefficient in 1/m and of a measured one, which may be null.
  explicit AbsorptionSpectrum(const Rgb& absorption, std::shared_ptr<const CoefficientSpectrum> measured = nullptr);

  SampledSpectrum at(const Wavelengths& wavelengths) const;

 private:
  SampledSpectrum of_rgb(const Wavelengths& wavelengths) const;

  RgbSpectrum transmittance_ = RgbSpectrum::reflectance(Rgb(1));  // of one over `scale_` metres
  float scale_ = 0;                                               // the largest component, 1/m
  bool constant_ = true;
  std::shared_ptr<const CoefficientSpectrum> measured_;
};

struct MediumSpectra {
  ScatteringSpectrum scattering;
  AbsorptionSpectrum absorption;
  RgbSpectrum source = RgbSpectrum::emission(Rgb(0));  // of emission: radiance where the medium is opaque

  // The emission coefficient: the source function times the absorption.
  SampledSpectrum emission_at(const SampledSpectrum& absorption_at, const Wavelengths& wavelengths) const {
    return source.at(wavelengths) * absorption_at;
  }
};

}  // namespace etendue
