// Participating media whose density depends on the position.                                  [Lang, sec. 4.1.2]
//
// All coefficients are the product of the density, a number without a unit, and coefficients that hold at density 1.
#pragma once
#include <memory>
#include <optional>

#include "medium/blackbody_table.h"
#include "medium/density_field.h"
#include "medium/medium.h"
#include "medium/random_stream.h"

namespace etendue {

// A part of a ray from one parameter to another; the direction may have any length.
struct RaySpan {
  Vec3 origin{0}, direction{0};
  float from = 0, to = 0;
};

// Coefficients at density 1, 1/m.
template <class Color>
struct HeterogeneousCoefficients {
  Color scattering{0};
  Color extinction{0};
  Color log_extinction{0};  // logarithm of `extinction`; -infinity for 0

  bool scatters() const { return !is_black(scattering); }
};
template <>
struct HeterogeneousCoefficients<SampledSpectrum> {
  SampledSpectrum scattering, extinction, log_extinction;
  SampledSpectrum emission;  // radiance per metre, at the highest temperature without its colour
  const Wavelengths* wavelengths = nullptr;

  bool scatters() const { return !is_black(scattering); }
};

struct HeterogeneousMedium : HeterogeneousCoefficients<Rgb> {
  MediumSpectra spectra;
  Rgb emission{0};  // radiance per metre, at the highest temperature without its colour
  // Of the hottest part, kelvin; 0: the colour and brightness of emission do not depend on the temperature.
  float temperature = 0;
  TransmittanceEstimator estimator = TransmittanceEstimator::residual_ratio;
  std::shared_ptr<const PhaseFunction> phase;
  std::shared_ptr<const DensityGrid> grid;
  Mat4 world_to_grid{1};  // to the unit cube of the grid
  std::optional<BlackbodyTable> blackbodies;

  // `additional` is further absorption at density 1, 1/m.
  HeterogeneousMedium(const MediumDescription& m, const Rgb& additional, std::shared_ptr<const DensityGrid> density,
                      const Mat4& to_grid);

  bool emits() const { return !is_black(emission); }
  // The coefficients at the wavelengths of a path, which must outlive them.
  HeterogeneousCoefficients<SampledSpectrum> at(const Wavelengths& wavelengths) const;

  // A point of the scene in the unit cube of the grid.
  Vec3 in_grid(const Vec3& position) const { return Vec3(world_to_grid * Vec4(position, 1)); }
  // The part of a ray inside the grid. Parameters are those of the ray; `metres` is the length of one unit of them.
  GridRay in_grid(const RaySpan& span) const;
  static float metres(const RaySpan& span) { return std::sqrt(glm::dot(span.direction, span.direction)); }

  // Emitted radiance per metre at a point of the unit cube with this density.
  Rgb emitted(const Vec3& p, float density) const;
  // The same in the colours of a path.
  Rgb emitted(const HeterogeneousCoefficients<Rgb>&, const Vec3& p, float density) const { return emitted(p, density); }
  SampledSpectrum emitted(const HeterogeneousCoefficients<SampledSpectrum>& coefficients, const Vec3& p,
                          float density) const;
};

// The optical depth of a span by the mean densities of the coarse cells, for MIS weights. It is a function of the span
// alone, the same in both directions up to rounding. It is at most kLargestApproximateDepth, so that its exponential is
// not zero where the transmittance is not.
inline constexpr float kLargestApproximateDepth = 64;
template <class Color>
Color approximate_depth(const HeterogeneousCoefficients<Color>& coefficients, float density_integral) {
  Color depth;
  for (int c = 0; c < kChannels<Color>; ++c)
    depth[c] = std::min(coefficients.extinction[c] * density_integral, kLargestApproximateDepth);
  return depth;
}
template <class Color>
Color approximate_depth(const HeterogeneousMedium& medium, const HeterogeneousCoefficients<Color>& coefficients,
                        const RaySpan& span) {
  float integral = 0;
  medium.grid->for_each_cell(medium.in_grid(span), [&](float from, float to, const DensityGrid::Cell& cell) {
    integral += cell.mean * (to - from);
    return true;
  });
  return approximate_depth(coefficients, integral * HeterogeneousMedium::metres(span));
}

// An estimate of the transmittance of a span without bias, by a given estimator.   [Lang, eq. 4.59]
template <class Color>
Color estimated_transmittance(const HeterogeneousMedium& medium, const HeterogeneousCoefficients<Color>& coefficients,
                              const RaySpan& span, TransmittanceEstimator estimator, RandomStream& random);
inline Rgb estimated_transmittance(const HeterogeneousMedium& medium, const RaySpan& span,
                                   TransmittanceEstimator estimator, RandomStream& random) {
  return estimated_transmittance<Rgb>(medium, medium, span, estimator, random);
}

// The same by the estimator of the medium.
inline Rgb estimated_transmittance(const HeterogeneousMedium& medium, const RaySpan& span, RandomStream& random) {
  return estimated_transmittance(medium, span, medium.estimator, random);
}

// Ratio tracking that also estimates the emitted radiance that reaches the start of the span.
template <class Color>
Color transmittance_and_emission(const HeterogeneousMedium& medium,
                                 const HeterogeneousCoefficients<Color>& coefficients, const RaySpan& span,
                                 RandomStream& random, Color& emitted);
inline Rgb transmittance_and_emission(const HeterogeneousMedium& medium, const RaySpan& span, RandomStream& random,
                                      Rgb& emitted) {
  return transmittance_and_emission<Rgb>(medium, medium, span, random, emitted);
}

}  // namespace etendue
