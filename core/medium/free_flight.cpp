#include "medium/free_flight.h"

#include <algorithm>
#include <cmath>

namespace etendue {

FreeFlight::FreeFlight(const Rgb& throughput, float random) {
  const Rgb positive(std::max(throughput.r, 0.0f), std::max(throughput.g, 0.0f), std::max(throughput.b, 0.0f));
  const float sum = positive.r + positive.g + positive.b;
  probability_ = sum > 0 && std::isfinite(sum) ? positive / sum : Rgb(1.0f / 3);
  float below = 0;
  // The last channel with a positive probability takes the rest.
  for (int c = 0; c < 3; ++c) {
    if (!(probability_[c] > 0)) continue;
    channel_ = c;
    if (random < below + probability_[c]) break;
    below += probability_[c];
  }
  const float stretched = std::clamp((random - below) / probability_[channel_], 0.0f, kOneMinusEpsilon);
  remaining_ = -std::log1p(-stretched);
}

FreeFlight::FreeFlight(const Rgb& densities, int channel, float random)
    : probability_(densities), channel_(channel), remaining_(-std::log1p(-std::min(random, kOneMinusEpsilon))) {}

FreeFlight FreeFlight::without_collision(const Rgb& throughput) {
  FreeFlight flight(throughput, 0);
  flight.remaining_ = kInfinity;
  return flight;
}

std::optional<float> FreeFlight::pass(const HomogeneousMedium& medium, float length) {
  const Rgb depth = medium.optical_depth(length);
  if (remaining_ >= depth[channel_]) {
    remaining_ -= depth[channel_];
    depth_ += depth;
    return {};
  }
  const float distance = std::min(remaining_ / medium.extinction[channel_], length);
  depth_ += medium.optical_depth(distance);
  extinction_ = medium.extinction;
  scattering_ = medium.scattering;
  return distance;
}

std::optional<float> FreeFlight::pass(const HeterogeneousMedium& medium, const RaySpan& span, RandomStream& random) {
  const GridRay ray = medium.in_grid(span);
  const float metres = HeterogeneousMedium::metres(span), chosen = medium.extinction[channel_];
  std::optional<float> collision;
  medium.grid->for_each_cell(ray, [&](float from, float to, const DensityGrid::Cell& cell) {
    const float per_parameter = cell.highest * metres;
    for (;;) {
      const float depth = chosen * per_parameter * (to - from);
      if (!(remaining_ < depth)) {
        remaining_ -= depth;
        depth_ += medium.extinction * (per_parameter * (to - from));
        return true;
      }
      const float step = remaining_ / (chosen * per_parameter);
      depth_ += medium.extinction * (per_parameter * step);
      from += step;
      const Vec3 p = ray.at(from);
      const float density = medium.grid->density(p);
      if (medium.emits()) emitted_ += weight(medium.extinction * cell.highest, medium.emitted(p, density));
      if (random.next() * cell.highest < density) {
        extinction_ = medium.extinction;
        scattering_ = medium.scattering;
        density_ = density;
        collision = from;
        return false;
      }
      depth_ -= medium.log_extinction - Rgb(medium.log_extinction[channel_]);
      remaining_ = random.next_exponential();
    }
  });
  return collision;
}

Rgb FreeFlight::densities() const {
  const float least = least_depth();
  Rgb densities(0);
  for (int c = 0; c < 3; ++c)
    if (probability_[c] > 0) densities[c] = probability_[c] * std::exp(least - depth_[c]) * extinction_[c];
  const float sum = densities.r + densities.g + densities.b;
  return sum > 0 && std::isfinite(sum) ? densities / sum : probability_;
}

Rgb FreeFlight::weight() const { return weight(extinction_, scattering_); }

// Exponentials are taken relative to the smallest optical depth, because all of them may underflow.
float FreeFlight::least_depth() const {
  float least = kInfinity;
  for (int c = 0; c < 3; ++c)
    if (probability_[c] > 0) least = std::min(least, depth_[c]);
  return least;
}

Rgb FreeFlight::weight(const Rgb& collision_density, const Rgb& value) const {
  const float least = least_depth();
  Rgb weight(0);
  float density = 0;
  for (int c = 0; c < 3; ++c) {
    if (!(probability_[c] > 0)) continue;  // the throughput of this channel is 0
    const float transmittance = std::exp(least - depth_[c]);
    density += probability_[c] * transmittance * collision_density[c];
    weight[c] = transmittance * value[c];
  }
  return density > 0 ? weight * absorption_ / density : Rgb(0);
}

float FreeFlight::survival() const {
  return (std::exp(-depth_.r) + std::exp(-depth_.g) + std::exp(-depth_.b)) * (1.0f / 3);
}

float FreeFlight::collision_density(const HomogeneousMedium& medium, float distance) const {
  const Rgb transmittance = medium.transmittance(distance);
  float density = 0;
  for (int c = 0; c < 3; ++c) density += probability_[c] * medium.extinction[c] * transmittance[c];
  return density;
}

}  // namespace etendue
