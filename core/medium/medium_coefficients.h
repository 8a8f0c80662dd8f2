// Coefficients of a medium in the colours of a path: RGB, or the four wavelengths of a spectral path.
#pragma once
#include <cmath>

#include "spectrum/rgb.h"
#include "spectrum/uplift.h"

namespace etendue {

template <class Color>
inline constexpr int kChannels = 3;
template <>
inline constexpr int kChannels<SampledSpectrum> = SampledSpectrum::kSize;

// exp(-depth) by channel.
template <class Color>
Color exponential_of(const Color& depth) {
  Color result;
  for (int c = 0; c < kChannels<Color>; ++c) result[c] = std::exp(-depth[c]);
  return result;
}

template <class Color>
struct MediumCoefficients {
  Color scattering{0};  // 1/m
  Color extinction{0};  // scattering plus absorption, 1/m
  Color emission{0};    // radiance per metre

  bool scatters() const { return !is_black(scattering); }
  bool emits() const { return !is_black(emission); }
  // Optical depth of a path of this length in metres, which may be infinite.
  Color optical_depth(float length) const {
    Color depth;
    for (int c = 0; c < kChannels<Color>; ++c) depth[c] = extinction[c] > 0 ? extinction[c] * length : 0;
    return depth;
  }
  // exp(-optical depth).                                                                     [Lang, eq. 4.59]
  Color transmittance(float length) const { return exponential_of(optical_depth(length)); }
  // The radiance that this length of the medium emits towards its start.                     [Lang, eq. 4.59]
  Color emitted(float length) const {
    const Color depth = optical_depth(length);
    Color radiance(0);
    for (int c = 0; c < kChannels<Color>; ++c)
      if (emission[c] > 0) radiance[c] = emission[c] * -std::expm1(-depth[c]) / extinction[c];
    return radiance;
  }
};

}  // namespace etendue
