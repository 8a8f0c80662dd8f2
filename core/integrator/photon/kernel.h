// The kernels of photon density estimation.                                                     [Jensen 2001, sec. 7.2]
//
// Every kernel has mean one over the disc, or in volumes over the ball, so that uniform illumination is unchanged. The
// Gaussian has the shape of [Jensen 2001], whose factor of 0.918 does not normalise it.
#pragma once
#include <array>
#include <cmath>

#include "base/parameter.h"

namespace etendue::photon {

enum class Kernel { constant, cone, gaussian };

// The number of dimensions of the region that photons are looked up in.
enum class Region { disc, ball };

// `t` is the squared distance over the squared radius, 0 to 1.
inline float kernel_weight(Kernel kernel, float t, Region region = Region::disc) {
  constexpr float kBeta = 1.953f, kAtRim = 0.14184795f;            // e^-beta
  constexpr float kMeanOfDisc = 0.57859f, kMeanOfBall = 0.50538f;  // of the unnormalised Gaussian
  switch (kernel) {
    case Kernel::cone:
      return (region == Region::disc ? 3.0f : 4.0f) * (1 - std::sqrt(t));
    case Kernel::gaussian:
      return (1 - (1 - std::exp(-0.5f * kBeta * t)) / (1 - kAtRim)) /
             (region == Region::disc ? kMeanOfDisc : kMeanOfBall);
    case Kernel::constant:
      break;
  }
  return 1;
}

}  // namespace etendue::photon

template <>
struct etendue::Options<etendue::photon::Kernel> {
  static constexpr std::array<etendue::Option, 3> kOptions{
      {{"constant", "Constant"}, {"cone", "Cone"}, {"gaussian", "Gaussian"}}};
};
