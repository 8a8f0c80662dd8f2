// Sampling of the distance to the next collision through homogeneous media whose extinction depends on the colour.
//
// One random number selects a colour channel c with probability P_c, in proportion to the throughput of the path, and
// the optical depth in that channel at which the collision happens. The densities of all channels are combined by the
// balance heuristic (multiple importance sampling of one sample [Veach 1997, sec. 9.2.4]):
//
//   collision at t      density  sum_c P_c sigma_t,c exp(-tau_c(t))      weight  sigma_s exp(-tau(t)) / density
//   no collision        probability  sum_c P_c exp(-tau_c(d))            weight  exp(-tau(d)) / probability
//
// Media that do not scatter attenuate without collisions, so that a segment through them has no variance.
#pragma once
#include <optional>

#include "medium/medium.h"

namespace etendue {

class FreeFlight {
 public:
  // `throughput` is that of the path at the start; `random` is uniform in [0, 1).
  FreeFlight(const Rgb& throughput, float random);
  // A flight from the same start that passes all media: for points on a segment that is known to have no collision
  // before them.
  static FreeFlight without_collision(const Rgb& throughput);

  // Passes through `length` metres, possibly infinite, of a medium. Returns the distance to a collision inside it, in
  // metres; the flight ends there.
  std::optional<float> pass(const HomogeneousMedium& medium, float length);
  // Passes through a medium that does not scatter.
  void attenuate(const Rgb& transmittance) { absorption_ *= transmittance; }

  // The factor of the throughput: after `pass` has returned a collision, or at the end of the flight.
  Rgb weight() const;
  // The probability of no collision so far, as the mean over the colour channels. Unlike the probability of this flight,
  // it is a function of the segment alone, the same in both directions. MIS weights of bidirectional techniques use it.
  float survival() const;
  // The density per metre of a collision after `distance` metres, if the flight starts in this medium.
  float collision_density(const HomogeneousMedium& medium, float distance) const;

 private:
  Rgb probability_{0};  // of the channels
  int channel_ = 0;
  float remaining_ = 0;  // optical depth to the collision, in the chosen channel
  Rgb depth_{0};         // optical depth so far
  Rgb absorption_{1};    // transmittance of media without scattering
  const HomogeneousMedium* collision_ = nullptr;
};

}  // namespace etendue
