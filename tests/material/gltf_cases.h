// Surfaces with the extensions of glTF, as tests look at them.
#pragma once
#include <random>
#include <string>
#include <vector>

#include "base/hash.h"
#include "material/surface.h"

namespace etendue::test {

struct GltfCase {
  std::string name;
  Material material;
  Vec3 coat_normal{0, 0, 1};
};

// Every extension, alone and over others, at the ends of its parameters and between.
std::vector<GltfCase> gltf_cases();
// The same without anything smooth, so that all of it has a density.
std::vector<GltfCase> rough_gltf_cases();

inline WideLobes<Rgb> lobes_of(const Material& material, const Vec3& coat_normal = Vec3(0, 0, 1)) {
  WideLobes<Rgb> lobes;
  add_lobes(SurfaceMaterial(material, {}), {}, lobes, coat_normal);
  return lobes;
}
inline WideLobes<Rgb> lobes_of(const GltfCase& c) { return lobes_of(c.material, c.coat_normal); }

inline Vec3 direction(float theta_degrees, float phi = 0.3f) {
  const float t = theta_degrees * kPi / 180;
  return {std::sin(t) * std::cos(phi), std::sin(t) * std::sin(phi), std::cos(t)};
}

struct Draw {
  std::mt19937 engine;
  explicit Draw(unsigned seed) : engine(seed) {}
  float one() { return to_unit_float(static_cast<uint32_t>(engine())); }
  Vec2 two() { return {one(), one()}; }
  LobeDraw lobe() {
    const float choice = one();
    return {choice, two()};
  }
  Vec3 anywhere() { return direction(180 * one(), 6.28f * one()); }
};

}  // namespace etendue::test
