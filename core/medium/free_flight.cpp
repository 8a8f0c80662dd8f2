#include "medium/free_flight.h"

#include <algorithm>
#include <cmath>

namespace etendue {

namespace {

// Relative probabilities: positive values over their sum, or equal ones if the sum is 0 or not finite.
template <class Color>
Color normalized_or(const Color& values, const Color& otherwise) {
  float sum = 0;
  for (int c = 0; c < kChannels<Color>; ++c) sum += values[c];
  return sum > 0 && std::isfinite(sum) ? values / sum : otherwise;
}

}  // namespace

template <class Color>
BasicFreeFlight<Color>::BasicFreeFlight(const Color& throughput, float random) {
  Color positive;
  for (int c = 0; c < kChannels<Color>; ++c) positive[c] = std::max(throughput[c], 0.0f);
  probability_ = normalized_or(positive, Color(1.0f / kChannels<Color>));
  float below = 0;
  // The last channel with a positive probability takes the rest.
  for (int c = 0; c < kChannels<Color>; ++c) {
    if (!(probability_[c] > 0)) continue;
    channel_ = c;
    if (random < below + probability_[c]) break;
    below += probability_[c];
  }
  const float stretched = std::clamp((random - below) / probability_[channel_], 0.0f, kOneMinusEpsilon);
  remaining_ = -std::log1p(-stretched);
}

template <class Color>
BasicFreeFlight<Color>::BasicFreeFlight(const Color& densities, int channel, float random)
    : probability_(densities), channel_(channel), remaining_(-std::log1p(-std::min(random, kOneMinusEpsilon))) {}

template <class Color>
BasicFreeFlight<Color> BasicFreeFlight<Color>::without_collision(const Color& throughput) {
  BasicFreeFlight flight(throughput, 0);
  flight.remaining_ = kInfinity;
  return flight;
}

template <class Color>
std::optional<float> BasicFreeFlight<Color>::pass(const Coefficients& medium, float length) {
  const Color depth = medium.optical_depth(length);
  if (remaining_ >= depth[channel_]) {
    remaining_ -= depth[channel_];
    depth_ += depth;
    survival_depth_ += depth;
    return {};
  }
  const float distance = std::min(remaining_ / medium.extinction[channel_], length);
  const Color depth_of_collision = medium.optical_depth(distance);
  depth_ += depth_of_collision;
  survival_depth_ += depth_of_collision;
  extinction_ = medium.extinction;
  scattering_ = medium.scattering;
  return distance;
}

template <class Color>
void BasicFreeFlight<Color>::pass_without_collision(const HeterogeneousMedium& medium,
                                                    const HeterogeneousCoefficients<Color>& coefficients,
                                                    const RaySpan& span) {
  const double integral =
      medium.grid->integral(medium.in_grid(span)) * static_cast<double>(HeterogeneousMedium::metres(span));
  depth_ += coefficients.extinction * static_cast<float>(integral);
  survival_depth_ += approximate_depth(medium, coefficients, span);
}

template <class Color>
std::optional<float> BasicFreeFlight<Color>::pass(const HeterogeneousMedium& medium,
                                                  const HeterogeneousCoefficients<Color>& coefficients,
                                                  const RaySpan& span, RandomStream& random) {
  if (remaining_ == kInfinity) {
    pass_without_collision(medium, coefficients, span);
    return {};
  }
  const GridRay ray = medium.in_grid(span);
  const float metres = HeterogeneousMedium::metres(span), chosen = coefficients.extinction[channel_];
  float mean_integral = 0;
  std::optional<float> collision;
  medium.grid->for_each_cell(ray, [&](float from, float to, const DensityGrid::Cell& cell) {
    const float per_parameter = cell.highest * metres, start = from;
    for (;;) {
      const float depth = chosen * per_parameter * (to - from);
      if (!(remaining_ < depth)) {
        remaining_ -= depth;
        depth_ += coefficients.extinction * (per_parameter * (to - from));
        mean_integral += cell.mean * (to - start);
        return true;
      }
      const float step = remaining_ / (chosen * per_parameter);
      depth_ += coefficients.extinction * (per_parameter * step);
      from += step;
      const Vec3 p = ray.at(from);
      const float density = medium.grid->density(p);
      if (medium.emits())
        emitted_ += weight(coefficients.extinction * cell.highest, medium.emitted(coefficients, p, density));
      if (random.next() * cell.highest < density) {
        extinction_ = coefficients.extinction;
        scattering_ = coefficients.scattering;
        density_ = density;
        collision = from;
        mean_integral += cell.mean * (from - start);
        return false;
      }
      depth_ -= coefficients.log_extinction - Color(coefficients.log_extinction[channel_]);
      remaining_ = random.next_exponential();
    }
  });
  survival_depth_ += approximate_depth(coefficients, mean_integral * metres);
  return collision;
}

template <class Color>
Color BasicFreeFlight<Color>::densities() const {
  const float least = least_depth();
  Color densities(0);
  for (int c = 0; c < kChannels<Color>; ++c)
    if (probability_[c] > 0) densities[c] = probability_[c] * std::exp(least - depth_[c]) * extinction_[c];
  return normalized_or(densities, probability_);
}

template <class Color>
Color BasicFreeFlight<Color>::weight() const {
  return weight(extinction_, scattering_);
}

// Exponentials are taken relative to the smallest optical depth, because all of them may underflow.
template <class Color>
float BasicFreeFlight<Color>::least_depth() const {
  float least = kInfinity;
  for (int c = 0; c < kChannels<Color>; ++c)
    if (probability_[c] > 0) least = std::min(least, depth_[c]);
  return least;
}

template <class Color>
Color BasicFreeFlight<Color>::weight(const Color& collision_density, const Color& value) const {
  const float least = least_depth();
  Color weight(0);
  float density = 0;
  for (int c = 0; c < kChannels<Color>; ++c) {
    if (!(probability_[c] > 0)) continue;  // the throughput of this channel is 0
    const float transmittance = std::exp(least - depth_[c]);
    density += probability_[c] * transmittance * collision_density[c];
    weight[c] = transmittance * value[c];
  }
  return density > 0 ? weight * absorption_ / density : Color(0);
}

template <class Color>
float BasicFreeFlight<Color>::survival() const {
  float sum = 0;
  for (int c = 0; c < kChannels<Color>; ++c) sum += std::exp(-survival_depth_[c]);
  return sum * (1.0f / kChannels<Color>);
}

template <class Color>
float BasicFreeFlight<Color>::collision_density(const Coefficients& medium, float distance) const {
  const Color transmittance = medium.transmittance(distance);
  float density = 0;
  for (int c = 0; c < kChannels<Color>; ++c) density += probability_[c] * medium.extinction[c] * transmittance[c];
  return density;
}

template class BasicFreeFlight<Rgb>;
template class BasicFreeFlight<SampledSpectrum>;

}  // namespace etendue
