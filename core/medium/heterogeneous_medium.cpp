#include "medium/heterogeneous_medium.h"

#include "spectrum/blackbody.h"

namespace etendue {
namespace {

constexpr size_t kTemperatures = 256;

// The emission relative to that at the highest temperature: the colour of a black body, and its total radiance by the
// law of Stefan and Boltzmann.
std::vector<Rgb> emission_by_temperature(const Rgb& emission, float highest) {
  std::vector<Rgb> table;
  const Rgb brightest = blackbody_color(std::clamp<double>(highest, kMinTemperature, kMaxTemperature));
  for (size_t i = 0; i < kTemperatures; ++i) {
    const double relative = static_cast<double>(i) / (kTemperatures - 1);
    const double kelvin = std::clamp(relative * static_cast<double>(highest), kMinTemperature, kMaxTemperature);
    table.push_back(emission * blackbody_color(kelvin) * static_cast<float>(std::pow(relative, 4)) /
                    luminance(brightest));
  }
  return table;
}

}  // namespace

HeterogeneousMedium::HeterogeneousMedium(const MediumDescription& m, const Rgb& additional,
                                         std::shared_ptr<const DensityGrid> density, const Mat4& to_grid)
    : spectra(m.scattering, m.absorption + additional),
      emission(m.emission * m.absorption),
      temperature(m.temperature),
      estimator(m.estimator),
      phase(m.phase.get()),
      grid(std::move(density)),
      world_to_grid(to_grid) {
  scattering = m.scattering;
  extinction = m.scattering + m.absorption + additional;
  log_extinction = Rgb(std::log(extinction.r), std::log(extinction.g), std::log(extinction.b));
  if (temperature > 0) emission_table = emission_by_temperature(emission, temperature);
}

HeterogeneousCoefficients<SampledSpectrum> HeterogeneousMedium::at(const Wavelengths& wavelengths) const {
  HeterogeneousCoefficients<SampledSpectrum> result;
  result.scattering = spectra.scattering.at(wavelengths);
  result.absorption = spectra.absorption.at(wavelengths);
  result.extinction = result.scattering + result.absorption;
  for (int i = 0; i < SampledSpectrum::kSize; ++i) result.log_extinction[i] = std::log(result.extinction[i]);
  result.spectra = &spectra;
  result.wavelengths = &wavelengths;
  return result;
}

GridRay HeterogeneousMedium::in_grid(const RaySpan& span) const {
  return DensityGrid::clipped(
      {Vec3(world_to_grid * Vec4(span.origin, 1)), Vec3(world_to_grid * Vec4(span.direction, 0)), span.from, span.to});
}

Rgb HeterogeneousMedium::emitted(const Vec3& p, float density) const {
  if (!emits()) return Rgb(0);
  if (emission_table.empty()) return emission * density;
  const float at = grid->temperature(p) * static_cast<float>(kTemperatures - 1);
  const size_t i = std::min(static_cast<size_t>(at), kTemperatures - 2);
  const float t = at - static_cast<float>(i);
  return (emission_table[i] * (1 - t) + emission_table[i + 1] * t) * density;
}

}  // namespace etendue
