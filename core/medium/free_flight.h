// Sampling of the distance to the next collision through media whose extinction depends on the colour.
//
// One random number selects a colour channel c with probability P_c, in proportion to the throughput of the path, and
// the optical depth in that channel at which the collision happens. The densities of all channels are combined by the
// balance heuristic (multiple importance sampling of one sample [Veach 1997, sec. 9.2.4]):
//
//   collision at t      density  sum_c P_c sigma_t,c exp(-tau_c(t))      weight  sigma_s exp(-tau(t)) / density
//   no collision        probability  sum_c P_c exp(-tau_c(d))            weight  exp(-tau(d)) / probability
//
// A path may also keep one channel, which is chosen before it starts. P_c is then the relative density of the path so
// far in channel c, so that the densities of whole paths are combined by the balance heuristic, as in hero wavelength
// sampling [Wilkie et al. 2014]. In media with the same albedo in all channels, both ways generate the same paths with
// the same weights, because the throughput of a channel is then proportional to that density. A kept channel can be
// stratified over the samples of a pixel.
//
// The channels are the three colours of Rgb or the four wavelengths of SampledSpectrum.
//
// Homogeneous media that do not scatter attenuate without collisions, so that a segment through them has no variance.
//
// Heterogeneous media are passed by delta tracking [Woodcock et al. 1965] with the majorant of each coarse cell. The
// density of a sequence of n null collisions and a collision in channel c is, for a majorant m and a density r,
//
//   prod over null collisions (m - r_i) sigma_t,c   times   r sigma_t,c exp(-sigma_t,c int m)
//
// with the extinction coefficient sigma_t,c at density 1. The same combination of channels by the balance heuristic
// applies [Miller et al. 2019]; the factors (m - r_i) cancel, and log(sigma_t,c) is subtracted from the optical depth
// of channel c at every null collision. A collision in a grid of constant density is therefore that of the homogeneous
// medium.
#pragma once
#include <optional>

#include "medium/heterogeneous_medium.h"

namespace etendue {

template <class Color>
class BasicFreeFlight {
 public:
  using Coefficients = MediumCoefficients<Color>;

  // `throughput` is that of the path at the start; `random` is uniform in [0, 1).
  BasicFreeFlight(const Color& throughput, float random);
  // A flight of a path that keeps one colour channel, which was chosen uniformly. `densities` are the relative
  // densities of the path so far in the channels; their sum is 1.
  BasicFreeFlight(const Color& densities, int channel, float random);
  // A flight from the same start that passes all media: for points on a segment that is known to have no collision
  // before them.
  static BasicFreeFlight without_collision(const Color& throughput);

  // Passes through `length` metres, possibly infinite, of a medium. Returns the distance to a collision inside it, in
  // metres; the flight ends there.
  std::optional<float> pass(const Coefficients& medium, float length);
  // The same through a heterogeneous medium, whose coefficients at density 1 are given; returns the parameter of the
  // ray. `random` is read after the first collision with the majorant.
  std::optional<float> pass(const HeterogeneousMedium& medium, const HeterogeneousCoefficients<Color>& coefficients,
                            const RaySpan& span, RandomStream& random);
  std::optional<float> pass(const HeterogeneousMedium& medium, const RaySpan& span,
                            RandomStream& random) requires(std::is_same_v<Color, Rgb>) {
    return pass(medium, medium, span, random);
  }
  // Passes through a medium that does not scatter.
  void attenuate(const Color& transmittance) { absorption_ *= transmittance; }

  // The factor of the throughput: after `pass` has returned a collision, or at the end of the flight.
  Color weight() const;
  // The probability of no collision so far, as the mean over the colour channels. Unlike the probability of this
  // flight, it is a function of the segment alone, the same in both directions. MIS weights of bidirectional techniques
  // use it. In heterogeneous media it is an approximation (approximate_depth).
  float survival() const;
  // The relative densities of the path up to here in the channels, for a path that keeps its channel.
  Color densities() const;
  // After `pass` has returned a collision: the scattering coefficient there, 1/m.
  Color scattering_at_collision() const { return scattering_ * density_; }
  // The density per metre of a collision after `distance` metres, if the flight starts in this medium.
  float collision_density(const Coefficients& medium, float distance) const;

  // Adds radiance that reaches the current end of the flight, before a collision.
  void add_emission(const Color& radiance) { emitted_ += weight() * radiance; }
  // The emitted radiance that reaches the start of the flight, estimated at each collision with a majorant. Its factor
  // is the throughput at the start.
  const Color& emitted() const { return emitted_; }

 private:
  // Passes through all of a heterogeneous medium without a collision.
  void pass_without_collision(const HeterogeneousMedium& medium, const HeterogeneousCoefficients<Color>& coefficients,
                              const RaySpan& span);
  Color weight(const Color& collision_density, const Color& value) const;
  // The smallest optical depth of a channel that has a probability.
  float least_depth() const;

  Color probability_{0};  // of the channels
  int channel_ = 0;
  float remaining_ = 0;      // optical depth to the collision, in the chosen channel
  Color depth_{0};           // optical depth so far
  Color survival_depth_{0};  // the optical depth of `survival`
  Color absorption_{1};      // transmittance of media without scattering
  Color emitted_{0};
  // At the collision: extinction and scattering coefficients of the medium, 1/m; 1 without a collision.
  // In heterogeneous media, those at density 1.
  Color extinction_{1}, scattering_{1};
  float density_ = 1;  // of the medium at the collision
};

using FreeFlight = BasicFreeFlight<Rgb>;

}  // namespace etendue
