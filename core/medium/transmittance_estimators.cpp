// The estimators of transmittance that heterogeneous_medium.h declares.
#include "medium/free_flight.h"
#include "medium/heterogeneous_medium.h"

namespace etendue {
namespace {

// The least mean number of points on a ray at which emission is evaluated.
constexpr float kEmissionPoints = 8;

template <class Color>
float smallest_component(const Color& color) {
  float smallest = color[0];
  for (int c = 1; c < kChannels<Color>; ++c) smallest = std::min(smallest, color[c]);
  return smallest;
}

// Russian roulette for channels whose estimate has become small: they keep their mean. One number for all channels, so
// that grey stays grey.
template <class Color>
void terminate_small_channels(Color& estimate, RandomStream& random) {
  constexpr float kSmall = 0.1f;
  if (smallest_component(estimate) >= kSmall) return;
  const float number = random.next() * kSmall;
  for (int c = 0; c < kChannels<Color>; ++c)
    if (estimate[c] < kSmall) estimate[c] = number < estimate[c] ? kSmall : 0;
}

// The largest extinction of the channels that contribute to an estimate. Collisions beyond its majorant have no effect.
template <class Color>
float largest_extinction(const HeterogeneousCoefficients<Color>& coefficients, const Color& estimate) {
  float largest = 0;
  for (int c = 0; c < kChannels<Color>; ++c)
    if (estimate[c] > 0) largest = std::max(largest, coefficients.extinction[c]);
  return largest;
}

// Visits collisions along a ray whose density is rate(cell), in 1/m, by visit(parameter, cell). The rate may change at
// a collision. enter(cell, length) is called for every coarse cell and its length in metres.
template <class Enter, class Rate, class Visit>
void for_each_collision(const HeterogeneousMedium& medium, const GridRay& ray, float metres, RandomStream& random,
                        Enter&& enter, Rate&& rate, Visit&& visit) {
  float remaining = random.next_exponential();
  medium.grid->for_each_cell(ray, [&](float from, float to, const DensityGrid::Cell& cell) {
    enter(cell, (to - from) * metres);
    for (;;) {
      const float per_parameter = rate(cell) * metres, depth = per_parameter * (to - from);
      if (!(remaining < depth)) {
        remaining -= depth;
        return true;
      }
      from += remaining / per_parameter;
      visit(from, cell);
      remaining = random.next_exponential();
    }
  });
}

// Ratio tracking                                                                              [Novak et al. 2014]
//
// Collisions are those of the majorant in the channel of the largest extinction. Each multiplies the estimate by the
// fraction of null collisions, in each channel. If emission is estimated, collisions are at least so frequent that a
// ray through a thin medium has several of them.
template <class Color>
Color ratio_tracking(const HeterogeneousMedium& medium, const HeterogeneousCoefficients<Color>& coefficients,
                     const RaySpan& span, RandomStream& random, Color* emitted) {
  const GridRay ray = medium.in_grid(span);
  Color estimate(1);
  const float metres = HeterogeneousMedium::metres(span), length = (ray.to - ray.from) * metres;
  const float least_rate = emitted && length > 0 ? kEmissionPoints / length : 0;  // 1/m
  float largest = largest_extinction(coefficients, estimate);
  const auto rate_in = [&](const DensityGrid::Cell& cell) {
    const float majorant = cell.highest * largest;
    return majorant > 0 ? std::max(majorant, least_rate) : 0.0f;
  };
  for_each_collision(
      medium, ray, metres, random, [](const DensityGrid::Cell&, float) {}, rate_in,
      [&](float at, const DensityGrid::Cell& cell) {
        const Vec3 p = ray.at(at);
        const float density = std::min(medium.grid->density(p), cell.highest), rate = rate_in(cell);
        if (emitted) *emitted += estimate * medium.emitted(coefficients, p, density) / rate;
        estimate *= Color(1) - coefficients.extinction * (density / rate);
        terminate_small_channels(estimate, random);
        largest = largest_extinction(coefficients, estimate);
      });
  return estimate;
}

// Residual ratio tracking                                                                     [Novak et al. 2014]
//
// The lowest density of each coarse cell attenuates in closed form. Ratio tracking estimates the rest, whose majorant
// is the difference between the highest and the lowest density.
template <class Color>
Color residual_ratio_tracking(const HeterogeneousMedium& medium, const HeterogeneousCoefficients<Color>& coefficients,
                              const RaySpan& span, RandomStream& random) {
  const GridRay ray = medium.in_grid(span);
  Color estimate(1);
  float largest = largest_extinction(coefficients, estimate);
  double control = 0;  // integral of the lowest densities
  for_each_collision(
      medium, ray, HeterogeneousMedium::metres(span), random,
      [&](const DensityGrid::Cell& cell, float length) {
        control += static_cast<double>(cell.lowest) * static_cast<double>(length);
      },
      [&](const DensityGrid::Cell& cell) { return (cell.highest - cell.lowest) * largest; },
      [&](float at, const DensityGrid::Cell& cell) {
        const float residual = std::clamp(medium.grid->density(ray.at(at)), cell.lowest, cell.highest) - cell.lowest;
        estimate *= Color(1) - coefficients.extinction * (residual / ((cell.highest - cell.lowest) * largest));
        terminate_small_channels(estimate, random);
        largest = largest_extinction(coefficients, estimate);
      });
  return estimate * exponential_of(coefficients.extinction * static_cast<float>(control));
}

// 1 if a free flight passes the span, else 0; in several colours weighted by the balance heuristic.
template <class Color>
Color delta_tracking(const HeterogeneousMedium& medium, const HeterogeneousCoefficients<Color>& coefficients,
                     const RaySpan& span, RandomStream& random) {
  BasicFreeFlight<Color> flight(Color(1), random.next());
  return flight.pass(medium, coefficients, span, random) ? Color(0) : flight.weight();
}

// The optical depth voxel by voxel, in closed form.                                          [Amanatides and Woo 1987]
template <class Color>
Color regular_tracking(const HeterogeneousMedium& medium, const HeterogeneousCoefficients<Color>& coefficients,
                       const RaySpan& span) {
  const auto depth = static_cast<float>(medium.grid->integral(medium.in_grid(span)));
  return exponential_of(coefficients.extinction * (depth * HeterogeneousMedium::metres(span)));
}

}  // namespace

template <class Color>
Color estimated_transmittance(const HeterogeneousMedium& medium, const HeterogeneousCoefficients<Color>& coefficients,
                              const RaySpan& span, TransmittanceEstimator estimator, RandomStream& random) {
  switch (estimator) {
    case TransmittanceEstimator::delta:
      return delta_tracking(medium, coefficients, span, random);
    case TransmittanceEstimator::ratio:
      return ratio_tracking<Color>(medium, coefficients, span, random, nullptr);
    case TransmittanceEstimator::residual_ratio:
      return residual_ratio_tracking(medium, coefficients, span, random);
    case TransmittanceEstimator::regular:
      return regular_tracking(medium, coefficients, span);
  }
  return Color(1);
}

template <class Color>
Color transmittance_and_emission(const HeterogeneousMedium& medium,
                                 const HeterogeneousCoefficients<Color>& coefficients, const RaySpan& span,
                                 RandomStream& random, Color& emitted) {
  return ratio_tracking(medium, coefficients, span, random, &emitted);
}

template Rgb estimated_transmittance(const HeterogeneousMedium&, const HeterogeneousCoefficients<Rgb>&, const RaySpan&,
                                     TransmittanceEstimator, RandomStream&);
template SampledSpectrum estimated_transmittance(const HeterogeneousMedium&,
                                                 const HeterogeneousCoefficients<SampledSpectrum>&, const RaySpan&,
                                                 TransmittanceEstimator, RandomStream&);
template Rgb transmittance_and_emission(const HeterogeneousMedium&, const HeterogeneousCoefficients<Rgb>&,
                                        const RaySpan&, RandomStream&, Rgb&);
template SampledSpectrum transmittance_and_emission(const HeterogeneousMedium&,
                                                    const HeterogeneousCoefficients<SampledSpectrum>&, const RaySpan&,
                                                    RandomStream&, SampledSpectrum&);

}  // namespace etendue
