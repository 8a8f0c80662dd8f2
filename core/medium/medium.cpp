#include "medium/medium.h"

#include "spectrum/blackbody.h"

namespace etendue {
namespace {

double temperature_in_range(float kelvin) { return std::clamp<double>(kelvin, kMinTemperature, kMaxTemperature); }

// The emission coefficient at the highest temperature.
Rgb emission_coefficient(const MediumDescription& m) {
  if (!(m.temperature > 0)) return m.emission * m.absorption;
  const Rgb color = blackbody_color(temperature_in_range(m.temperature));
  return m.emission * m.absorption * color / luminance(color);
}

std::shared_ptr<const EmissionSpectrum> blackbody_of(const MediumDescription& m) {
  if (!m.emits() || !(m.temperature > 0)) return nullptr;
  return std::make_shared<const EmissionSpectrum>(*Spectrum::blackbody(temperature_in_range(m.temperature)));
}

}  // namespace

void MediumDescription::set_spectrum(Coefficient coefficient, const CoefficientSpectrumRef& spectrum) {
  if (coefficient == Coefficient::scattering) {
    scattering_spectrum = spectrum;
    if (spectrum) scattering = spectrum.spectrum->rgb_of_scattering();
  } else {
    absorption_spectrum = spectrum;
    if (spectrum) absorption = spectrum.spectrum->rgb_of_absorption();
  }
}

MediumSpectra MediumDescription::spectra(const Rgb& additional) const {
  MediumSpectra result;
  result.scattering =
      scattering_spectrum ? ScatteringSpectrum(scattering_spectrum.spectrum) : ScatteringSpectrum(scattering);
  result.absorption = absorption_spectrum ? AbsorptionSpectrum(additional, absorption_spectrum.spectrum)
                                          : AbsorptionSpectrum(absorption + additional);
  if (emits()) result.source = RgbSpectrum::emission(ratio(emission * absorption, absorption + additional));
  return result;
}

HomogeneousMedium::HomogeneousMedium(const MediumDescription& m, const Rgb& additional)
    : MediumCoefficients<Rgb>{m.scattering, m.scattering + m.absorption + additional, emission_coefficient(m)},
      spectra(m.spectra(additional)),
      blackbody(blackbody_of(m)),
      phase(m.phase.get()) {}

MediumCoefficients<SampledSpectrum> HomogeneousMedium::at(const Wavelengths& wavelengths) const {
  const SampledSpectrum sigma_s = spectra.scattering.at(wavelengths), sigma_a = spectra.absorption.at(wavelengths);
  SampledSpectrum emitted(0);
  if (emits()) emitted = spectra.emission_at(sigma_a, wavelengths);
  if (blackbody) emitted *= blackbody->at(wavelengths);
  return {sigma_s, sigma_s + sigma_a, emitted};
}

}  // namespace etendue
