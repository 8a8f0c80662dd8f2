#include "medium/coefficient_spectrum.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "spectrum/spectrum_points.h"

namespace etendue {
namespace {

// Absorption of pure water at 400, 410, ..., 700 nm, 1/m.                              [Pope and Fry 1997, table 3]
constexpr std::array<double, 31> kPureWater{0.00663, 0.00473, 0.00454, 0.00495, 0.00635, 0.00922, 0.00979, 0.0106,
                                            0.0127,  0.0150,  0.0204,  0.0325,  0.0409,  0.0434,  0.0474,  0.0565,
                                            0.0619,  0.0695,  0.0896,  0.1351,  0.2224,  0.2644,  0.2755,  0.2916,
                                            0.3108,  0.3400,  0.4100,  0.4390,  0.4650,  0.5160,  0.6240};

Spectrum pure_water() {
  std::vector<Spectrum::Sample> samples;
  for (size_t i = 0; i < kPureWater.size(); ++i) samples.push_back({400 + 10 * static_cast<double>(i), kPureWater[i]});
  return *Spectrum::piecewise_linear(std::move(samples));
}

// Rayleigh scattering of air at sea level, 288.15 K, 1/m; the wavelength in micrometres.        [Bucholtz 1995]
double scattering_of_air(double wavelength) {
  const auto fit = [&](double a, double b, double c, double d) {
    return a * std::pow(wavelength, -(b + c * wavelength + d / wavelength));
  };
  const double per_km = wavelength <= 0.5 ? fit(7.68246e-4, 3.55212, 1.35579, 0.11563)
                                          : fit(10.21675e-4, 3.99668, 1.10298e-3, 2.71393e-2);
  return per_km / 1000;
}

Spectrum air() {
  std::vector<Spectrum::Sample> samples;
  for (double nm = kFirstWavelength; nm <= kLastWavelength; nm += 5)
    samples.push_back({nm, scattering_of_air(nm / 1000)});
  return *Spectrum::piecewise_linear(std::move(samples));
}

using Values = std::array<double, WavelengthTable::kNodes>;

Rgb rgb_of_absorption(const Values& values) {
  constexpr double kLeastTransmittance = 1e-4;
  constexpr int kIterations = 16;
  double largest = *std::ranges::max_element(values);
  std::array<double, 3> absorption{};
  // The distance and the coefficients depend on each other.
  for (int k = 0; k < kIterations && largest > 0; ++k) {
    const double distance = 1 / largest;
    Values transmittance;
    for (size_t i = 0; i < values.size(); ++i) transmittance[i] = std::exp(-values[i] * distance);
    const auto rgb = WavelengthTable::rgb_of(transmittance);
    for (size_t c = 0; c < 3; ++c) absorption[c] = -std::log(std::clamp(rgb[c], kLeastTransmittance, 1.0)) / distance;
    largest = *std::ranges::max_element(absorption);
  }
  return Rgb(static_cast<float>(absorption[0]), static_cast<float>(absorption[1]), static_cast<float>(absorption[2]));
}

// The value of a spectrum, which is constant outside of its table.
double extended(const Spectrum& spectrum, double wavelength) {
  const auto [first, last] = spectrum.range();
  return spectrum(std::clamp(wavelength, first, last));
}

constexpr double kLargestCoefficient = 1e6;  // 1/m

Result<CoefficientSpectrum> prepared(Coefficient coefficient, const std::string& name) {
  for (const NamedCoefficient& named : named_coefficients())
    if (named.coefficient == coefficient && name == named.name) return CoefficientSpectrum(named.make());
  const auto spectrum = is_point_list(name) ? spectrum_of_points(name) : read_spectrum(name);
  if (!spectrum) return spectrum.error();
  for (size_t i = 0; i < WavelengthTable::kNodes; ++i)
    if (extended(*spectrum, WavelengthTable::wavelength(i)) > kLargestCoefficient)
      return input_error(name + ": a coefficient is larger than 1e6 per metre");
  return CoefficientSpectrum(*spectrum);
}

template <Coefficient coefficient>
Result<void> accepts(std::string_view name) {
  const auto found = find_coefficient_spectrum(coefficient, name);
  if (!found) return found.error();
  return {};
}

}  // namespace

CoefficientSpectrum::CoefficientSpectrum(const Spectrum& spectrum) {
  Values values;
  for (size_t i = 0; i < values.size(); ++i) {
    values[i] = extended(spectrum, WavelengthTable::wavelength(i));
    values_[i] = static_cast<float>(values[i]);
  }
  const auto scattering = WavelengthTable::rgb_of(values);
  for (int c = 0; c < 3; ++c)
    rgb_of_scattering_[c] = static_cast<float>(std::max(scattering[static_cast<size_t>(c)], 0.0));
  rgb_of_absorption_ = etendue::rgb_of_absorption(values);
}

const std::vector<NamedCoefficient>& named_coefficients() {
  static const std::vector<NamedCoefficient> all{
      {"pure-water", "Pure water", "[Pope and Fry 1997], 400 to 700 nm", Coefficient::absorption, pure_water},
      {"air", "Air at sea level", "[Bucholtz 1995]", Coefficient::scattering, air}};
  return all;
}

Result<CoefficientSpectrumRef> find_coefficient_spectrum(Coefficient coefficient, std::string_view name) {
  static NamedSpectra<CoefficientSpectrum> scattering, absorption;
  CoefficientSpectrumRef ref;
  if (name.empty() || name == kNoCoefficientSpectrum) return ref;
  ref.name = name;
  auto& known = coefficient == Coefficient::scattering ? scattering : absorption;
  const auto spectrum = known.find(ref.name, [&](const std::string& key) { return prepared(coefficient, key); });
  if (!spectrum) return spectrum.error();
  ref.spectrum = *spectrum;
  return ref;
}

bool names_coefficient_file(std::string_view name) {
  return !is_point_list(name) &&
         std::ranges::none_of(named_coefficients(), [&](const NamedCoefficient& c) { return name == c.name; });
}

Text coefficient_spectrum_parameter(Coefficient coefficient, const CoefficientSpectrumRef& value) {
  const bool scatters = coefficient == Coefficient::scattering;
  std::vector<Option> options{{kNoCoefficientSpectrum, "From the RGB coefficient"}};
  for (const NamedCoefficient& named : named_coefficients())
    if (named.coefficient == coefficient) options.push_back({named.name, named.label});
  return {scatters ? "scattering-spectrum" : "absorption-spectrum",
          scatters ? "Scattering spectrum" : "Absorption spectrum",
          value ? value.name : kNoCoefficientSpectrum,
          "Measured coefficient by wavelength, points such as 400:0.2 700:1, or a file with a wavelength in nm and a "
          "coefficient in 1/m per row. Sets the RGB coefficient, which RGB rendering uses. None: a smooth spectrum of "
          "the RGB coefficient",
          scatters ? accepts<Coefficient::scattering> : accepts<Coefficient::absorption>,
          std::move(options)};
}

}  // namespace etendue
