#include "medium/medium.h"

#include "spectrum/blackbody.h"

namespace etendue {
namespace {

// The emission coefficient at the highest temperature.
Rgb emission_coefficient(const MediumDescription& m) {
  if (!(m.temperature > 0)) return m.emission * m.absorption;
  const Rgb color = blackbody_color(std::clamp<double>(m.temperature, kMinTemperature, kMaxTemperature));
  return m.emission * m.absorption * color / luminance(color);
}

}  // namespace

HomogeneousMedium::HomogeneousMedium(const MediumDescription& m)
    : scattering(m.scattering),
      extinction(m.scattering + m.absorption),
      emission(emission_coefficient(m)),
      phase(m.phase.get()) {}

Rgb HomogeneousMedium::emitted(float length) const {
  const Rgb depth = optical_depth(length);
  Rgb radiance(0);
  for (int c = 0; c < 3; ++c)
    if (emission[c] > 0) radiance[c] = emission[c] * -std::expm1(-depth[c]) / extinction[c];
  return radiance;
}

}  // namespace etendue
