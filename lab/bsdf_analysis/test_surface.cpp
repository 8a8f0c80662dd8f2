#include "bsdf_analysis/test_surface.h"

#include "base/hash.h"

namespace etendue::bsdf_analysis {

Lobes lobes_of(const Material& material) {
  Lobes lobes;
  add_lobes(SurfaceMaterial(material, {}), {}, lobes);
  return lobes;
}

Vec3 direction(double degrees, double azimuth_degrees) {
  constexpr double kRadians = 3.14159265358979323846 / 180;
  const double theta = degrees * kRadians, phi = azimuth_degrees * kRadians;
  return {static_cast<float>(std::sin(theta) * std::cos(phi)), static_cast<float>(std::sin(theta) * std::sin(phi)),
          static_cast<float>(std::cos(theta))};
}

float relative_eta(const Lobes& lobes) {
  for (uint32_t i = 0; i < 256; ++i) {
    LobeSample<Rgb> s;
    if (lobes.sample(Vec3(0, 0, 1), draw_of(0, i), TransportMode::radiance, s) && s.transmitted) return s.eta;
  }
  return 1;
}

bool transmits_light(const Lobes& lobes) {
  for (uint32_t i = 0; i < 256; ++i) {
    LobeSample<Rgb> s;
    if (lobes.sample(Vec3(0, 0, 1), draw_of(0, i), TransportMode::radiance, s) && s.wi.z < 0) return true;
  }
  return false;
}

LobeRandom draw_of(uint32_t replicate, uint32_t i) {
  // Powers of 1 / g in units of 2^-32, with g the root of x^4 = x + 1.
  constexpr uint32_t kSteps[3] = {0xd1b54a35U, 0xabc98389U, 0x8cb92ba7U};
  const auto number = [&](uint32_t dimension) {
    return to_unit_float(hash_combine(replicate, dimension) + i * kSteps[dimension]);
  };
  return {number(0), Vec2(number(1), number(2))};
}

}  // namespace etendue::bsdf_analysis
