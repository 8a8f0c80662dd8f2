// The kernels of photon density estimation.                                                     [Jensen 2001, sec. 7.2]
//
// Every kernel has mean one over the disc, so that uniform illumination is unchanged. The Gaussian has the shape of
// [Jensen 2001], whose factor of 0.918 does not normalise it.
#pragma once
#include <array>
#include <cmath>

#include "base/parameter.h"

namespace etendue::photon {

enum class Kernel { constant, cone, gaussian };

// `t` is the squared distance over the squared radius, 0 to 1.
inline float kernel_weight(Kernel kernel, float t) {
  constexpr float kBeta = 1.953f, kAtRim = 0.14184795f;  // e^-beta
  constexpr float kMean = 0.57859f;                      // of the unnormalised kernel
  switch (kernel) {
    case Kernel::cone:
      return 3 * (1 - std::sqrt(t));
    case Kernel::gaussian:
      return (1 - (1 - std::exp(-0.5f * kBeta * t)) / (1 - kAtRim)) / kMean;
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
