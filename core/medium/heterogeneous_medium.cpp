#include "medium/heterogeneous_medium.h"

namespace etendue {

HeterogeneousMedium::HeterogeneousMedium(const MediumDescription& m, const Rgb& additional,
                                         std::shared_ptr<const DensityGrid> density, const Mat4& to_grid)
    : spectra(m.spectra(additional)),
      emission(m.emission * m.absorption),
      temperature(m.temperature),
      estimator(m.estimator),
      phase(m.phase.get()),
      grid(std::move(density)),
      world_to_grid(to_grid) {
  scattering = m.scattering;
  extinction = m.scattering + m.absorption + additional;
  log_extinction = Rgb(std::log(extinction.r), std::log(extinction.g), std::log(extinction.b));
  if (temperature > 0) blackbodies.emplace(temperature);
}

HeterogeneousCoefficients<SampledSpectrum> HeterogeneousMedium::at(const Wavelengths& wavelengths) const {
  HeterogeneousCoefficients<SampledSpectrum> result;
  const SampledSpectrum absorption = spectra.absorption.at(wavelengths);
  result.scattering = spectra.scattering.at(wavelengths);
  result.extinction = result.scattering + absorption;
  for (int i = 0; i < SampledSpectrum::kSize; ++i) result.log_extinction[i] = std::log(result.extinction[i]);
  if (emits()) result.emission = spectra.emission_at(absorption, wavelengths);
  result.wavelengths = &wavelengths;
  return result;
}

GridRay HeterogeneousMedium::in_grid(const RaySpan& span) const {
  return DensityGrid::clipped(
      {Vec3(world_to_grid * Vec4(span.origin, 1)), Vec3(world_to_grid * Vec4(span.direction, 0)), span.from, span.to});
}

Rgb HeterogeneousMedium::emitted(const Vec3& p, float density) const {
  if (!emits()) return Rgb(0);
  return blackbodies ? emission * blackbodies->at(grid->temperature(p)) * density : emission * density;
}

SampledSpectrum HeterogeneousMedium::emitted(const HeterogeneousCoefficients<SampledSpectrum>& coefficients,
                                             const Vec3& p, float density) const {
  if (!emits()) return SampledSpectrum(0);
  if (!blackbodies) return coefficients.emission * density;
  return coefficients.emission * blackbodies->at(grid->temperature(p), *coefficients.wavelengths) * density;
}

}  // namespace etendue
