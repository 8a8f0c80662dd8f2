// Materials with glTF extensions, as test cases.
#pragma once
#include <random>
#include <string>
#include <vector>

#include "base/hash.h"
#include "material/gltf_surface.h"
#include "support/directions.h"

namespace etendue::test {

struct GltfCase {
  std::string name;
  Material material;
  Vec3 coat_normal{0, 0, 1};
};

// Every extension, alone and combined with others, at the ends of its parameter ranges and in between.
std::vector<GltfCase> gltf_cases();
// The same without smooth surfaces, so that every lobe has a density.
std::vector<GltfCase> rough_gltf_cases();

inline AllLobes<Rgb> lobes_of(const Material& material, const Vec3& coat_normal = Vec3(0, 0, 1)) {
  AllLobes<Rgb> lobes;
  add_lobes(SurfaceMaterial(material, {}), {}, lobes, coat_normal);
  return lobes;
}
inline AllLobes<Rgb> lobes_of(const GltfCase& c) { return lobes_of(c.material, c.coat_normal); }

}  // namespace etendue::test
