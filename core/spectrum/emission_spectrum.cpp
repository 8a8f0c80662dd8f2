#include "spectrum/emission_spectrum.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "spectrum/spectrum_names.h"
#include "spectrum/uplift.h"

namespace etendue {
namespace {

std::vector<Option> spectrum_presets() {
  std::vector<Option> options{{kNoSpectrum, "From the colour"}};
  for (const Illuminant& illuminant : illuminants()) options.push_back({illuminant.name, illuminant.label});
  return options;
}

Result<void> accepts_emission_spectrum(std::string_view name) {
  const auto found = find_emission_spectrum(name);
  if (!found) return found.error();
  return {};
}

// The mean of the visible part within half a nanometre, so that narrow lines are not missed.
double mean_around(const Spectrum& spectrum, double wavelength) {
  constexpr int kSteps = 20;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i)
    sum += spectrum(std::clamp(wavelength - 0.5 + (i + 0.5) / kSteps, kFirstWavelength, kLastWavelength));
  return sum / kSteps;
}

Result<EmissionSpectrum> prepared(const std::string& name) {
  const auto spectrum = find_spectrum(name);
  if (!spectrum) return spectrum.error();
  EmissionSpectrum emission(*spectrum);
  if (is_black(emission.rgb()))
    return input_error("'" + name + "' emits no visible light; give a spectrum with power between 380 and 780 nm");
  return emission;
}

}  // namespace

EmissionSpectrum::EmissionSpectrum(const Spectrum& spectrum) {
  constexpr size_t kNodes = WavelengthTable::kNodes;
  std::array<double, kNodes> relative{};
  for (size_t i = 0; i < kNodes; ++i) {
    const double wavelength = WavelengthTable::wavelength(i);
    relative[i] = mean_around(spectrum, wavelength) / d65_at(wavelength);
  }
  const auto sum = WavelengthTable::rgb_of(relative);
  const double luminance = 0.2126 * sum[0] + 0.7152 * sum[1] + 0.0722 * sum[2];
  if (!(luminance > 0)) {
    rgb_ = Rgb(0);
    return;
  }
  for (size_t i = 0; i < kNodes; ++i) values_[i] = static_cast<float>(relative[i] / luminance);
  for (int c = 0; c < 3; ++c) rgb_[c] = static_cast<float>(std::max(sum[static_cast<size_t>(c)] / luminance, 0.0));
}

// Components outside the gamut take the largest factor of the others.
Rgb EmissionSpectrum::factor_of(const Rgb& emitted) const {
  Rgb factor = ratio(emitted, rgb_);
  const float largest = max_component(factor);
  for (int c = 0; c < 3; ++c)
    if (rgb_[c] == 0) factor[c] = largest;
  return factor;
}

SampledSpectrum EmissionSpectrum::emission(const Rgb& emitted, const Wavelengths& wavelengths) const {
  constexpr float kRounding = 1e-5f;
  const Rgb factor = factor_of(emitted);
  const auto [least, largest] = std::minmax({factor.r, factor.g, factor.b});
  if (largest - least <= kRounding * largest) return at(wavelengths) * largest;
  return at(wavelengths) * uplift_emission(factor, wavelengths);
}

Result<EmissionSpectrumRef> find_emission_spectrum(std::string_view name) {
  static NamedSpectra<EmissionSpectrum> known;
  EmissionSpectrumRef ref;
  if (name.empty() || name == kNoSpectrum) return ref;
  ref.name = name;
  const auto spectrum = known.find(ref.name, prepared);
  if (!spectrum) return spectrum.error();
  ref.spectrum = *spectrum;
  return ref;
}

EmissionSpectrumRef emission_spectrum_or_none(std::string_view name) {
  const auto found = find_emission_spectrum(name);
  return found ? *found : EmissionSpectrumRef();
}

Text emission_spectrum_parameter(const char* name, const EmissionSpectrumRef& value) {
  return {
      name,
      "Spectrum",
      value ? value.name : kNoSpectrum,
      "Distribution over the wavelengths: an illuminant, a temperature such as 2700K, points such as 400:0.2 700:1, "
      "or a file with a wavelength in nm and a value per row. The colour multiplies it. None: a smooth spectrum of the "
      "colour",
      accepts_emission_spectrum,
      spectrum_presets()};
}

}  // namespace etendue
