// Coefficients of media at the wavelengths of a path, derived from RGB coefficients.
//
// Both coefficients are smooth, bounded and not negative. RGB coefficients without colour give constant spectra.
//
//   scattering  sigma_s(lambda) = m S(lambda), where S has the RGB value sigma_s / m and m is twice the largest component:
//               the RGB value of the spectrum is the RGB coefficient, so that thin media show the same colour
//   absorption  sigma_a(lambda) = -ln S(lambda) / d, where S has the RGB value exp(-sigma_a d) and d is one over the
//               largest component: the transmittance of d metres has the RGB value that Beer's law gives for RGB
//
// S is the smooth reflectance spectrum of [Jakob and Hanika 2019]. At other thicknesses the colours of RGB and spectral
// rendering differ, because Beer's law holds for each wavelength.
#pragma once
#include "medium/medium_coefficients.h"

namespace etendue {

// An absorption coefficient by wavelength, 1/m.
class AbsorptionSpectrum {
 public:
  AbsorptionSpectrum() = default;
  // `absorption` is the RGB coefficient, 1/m.
  explicit AbsorptionSpectrum(const Rgb& absorption);

  SampledSpectrum at(const Wavelengths& wavelengths) const;

 private:
  RgbSpectrum transmittance_ = RgbSpectrum::reflectance(Rgb(1));  // of one over `scale_` metres
  float scale_ = 0;                                               // the largest component, 1/m
  bool constant_ = true;
};

struct MediumSpectra {
  RgbSpectrum scattering;
  AbsorptionSpectrum absorption;
  Rgb rgb_absorption{0};

  MediumSpectra() = default;
  MediumSpectra(const Rgb& scattering_coefficient, const Rgb& absorption_coefficient)
      : scattering(RgbSpectrum::emission(scattering_coefficient)),
        absorption(absorption_coefficient),
        rgb_absorption(absorption_coefficient) {}

  // The emission coefficient whose RGB value is `emission`: the spectrum of the source function times the absorption.
  SampledSpectrum emission_at(const Rgb& emission, const SampledSpectrum& absorption_at,
                              const Wavelengths& wavelengths) const {
    if (is_black(emission)) return SampledSpectrum(0);
    return uplift_emission(ratio(emission, rgb_absorption), wavelengths) * absorption_at;
  }
};

}  // namespace etendue
