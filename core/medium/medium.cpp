#include "medium/medium.h"

#include "spectrum/blackbody.h"

namespace etendue {
namespace {

// The emission coefficient at the highest temperature.
Rgb emission_coefficient(const MediumDescription& m) {
  if (!(m.temperature > 0)) return m.emission * m.absorption;
  const Rgb color = blackbody_color(std::clamp<double>(m.temperature, kMinTemperature, kMaxTemperature));
  return m.emission * m.absorption * color / luminance(color);
}

}  // namespace

HomogeneousMedium::HomogeneousMedium(const MediumDescription& m, const Rgb& additional)
    : MediumCoefficients<Rgb>{m.scattering, m.scattering + m.absorption + additional, emission_coefficient(m)},
      spectra(m.scattering, m.absorption + additional),
      phase(m.phase.get()) {}

MediumCoefficients<SampledSpectrum> HomogeneousMedium::at(const Wavelengths& wavelengths) const {
  const SampledSpectrum sigma_s = spectra.scattering.at(wavelengths), sigma_a = spectra.absorption.at(wavelengths);
  return {sigma_s, sigma_s + sigma_a, spectra.emission_at(emission, sigma_a, wavelengths)};
}

}  // namespace etendue
