#include "support/gltf_cases.h"

namespace etendue::test {
namespace {

Material base(float metallic, float roughness) {
  Material m;
  m.base_color = {0.8f, 0.6f, 0.4f};
  m.metallic = metallic;
  m.roughness = roughness;
  return m;
}

Material glass(float thickness, float roughness, float ior = 1.5f) {
  Material m = base(0, roughness);
  m.transmission = 1;
  m.thickness = thickness;
  m.ior = ior;
  return m;
}

Material coated(Material m, float strength, float roughness) {
  m.clearcoat = strength;
  m.clearcoat_roughness = roughness;
  return m;
}

Material with_sheen(Material m, float roughness) {
  m.sheen_color = {0.9f, 0.5f, 0.2f};
  m.sheen_roughness = roughness;
  return m;
}

Material with_film(Material m, float strength, float ior, float thickness) {
  m.iridescence = strength;
  m.iridescence_ior = ior;
  m.iridescence_thickness_max = thickness;
  return m;
}

Material translucent(Material m, float share, float thickness = 0) {
  m.diffuse_transmission = share;
  m.diffuse_transmission_color = {0.3f, 0.9f, 0.5f};
  m.thickness = thickness;
  return m;
}

Material tinted(Material m, float specular) {
  m.specular = specular;
  m.specular_color = {1, 0.5f, 0.2f};
  return m;
}

Material energy_conserving(Material m) {
  m.layering = Layering::energy_conserving;
  return m;
}

Material glossy(float roughness) {
  Material m = base(0, roughness);
  m.specular_glossiness = true;
  m.specular_color = {0.3f, 0.2f, 0.1f};
  return m;
}

}  // namespace

std::vector<GltfCase> rough_gltf_cases() {
  const Vec3 bent = direction(25, 2);
  return {
      {"coat over a dielectric", coated(base(0, 0.5f), 1, 0.2f)},
      {"rough coat over a metal", coated(base(1, 0.3f), 0.7f, 1)},
      {"tilted coat over a metal", coated(base(1, 0.5f), 1, 0.4f), bent},
      {"coat over rough glass", coated(glass(1, 0.4f), 1, 0.3f)},
      {"sheen of roughness 0", with_sheen(base(0, 0.8f), 0)},
      {"sheen of roughness 0.3", with_sheen(base(0, 0.8f), 0.3f)},
      {"sheen of roughness 1 over a metal", with_sheen(base(1, 0.4f), 1)},
      {"coat over sheen", coated(with_sheen(base(0.5f, 0.6f), 0.6f), 0.8f, 0.3f)},
      {"film on a dielectric", with_film(base(0, 0.4f), 1, 1.3f, 400)},
      {"film on a metal", with_film(base(1, 0.4f), 1, 1.8f, 550)},
      {"half a film on half a metal", with_film(base(0.5f, 1), 0.5f, 2.5f, 800)},
      {"film without thickness", with_film(base(0.5f, 0.5f), 1, 1.3f, 0)},
      {"film without index", with_film(base(0.5f, 0.5f), 1, 1, 400)},
      {"film on a thin sheet", with_film(glass(0, 0.4f), 1, 1.6f, 300)},
      {"film on rough glass", with_film(glass(1, 0.4f), 1, 1.6f, 300)},
      {"paper", translucent(base(0, 0.6f), 0.5f)},
      {"diffuse transmission only", translucent(base(0, 1), 1)},
      {"wax", translucent(base(0.2f, 0.4f), 0.7f, 1)},
      {"paper under a film", with_film(translucent(base(0, 0.4f), 0.5f), 1, 1.8f, 500)},
      {"thin sheet with diffuse transmission", translucent(
                                                   [] {
                                                     Material m = glass(0, 0.5f);
                                                     m.transmission = 0.5f;
                                                     return m;
                                                   }(),
                                                   0.5f)},
      {"everything",
       coated(with_sheen(with_film(translucent(
                                       [] {
                                         Material m = glass(0, 0.5f);
                                         m.transmission = 0.5f;
                                         m.metallic = 0.3f;
                                         return m;
                                       }(),
                                       0.5f),
                                   0.5f, 1.4f, 600),
                         0.5f),
              0.6f, 0.4f),
       bent},
      {"weak glass", tinted(glass(1, 0.4f), 0.5f)},
      {"coloured glass of index 2.5", tinted(glass(1, 0.6f, 2.5f), 1)},
      {"specular and glossiness", glossy(0.4f)},
      {"energy-conserving plastic", energy_conserving(base(0, 0.4f))},
      {"energy-conserving paper under a coat", energy_conserving(coated(translucent(base(0, 0.3f), 0.5f), 1, 0.5f))},
      {"energy-conserving film", energy_conserving(with_film(base(0.2f, 0.4f), 1, 1.6f, 300))},
  };
}

std::vector<GltfCase> gltf_cases() {
  auto all = rough_gltf_cases();
  all.push_back({"smooth coat", coated(base(0, 0.5f), 1, 0)});
  all.push_back({"smooth tilted coat over a mirror", coated(base(1, 0), 1, 0), direction(20, 1)});
  all.push_back({"smooth coat over smooth glass", coated(glass(1, 0), 1, 0)});
  all.push_back({"film on smooth glass", with_film(glass(1, 0), 1, 1.6f, 300)});
  all.push_back({"film on a smooth thin sheet", with_film(glass(0, 0), 1, 1.6f, 300)});
  all.push_back({"weak smooth glass", tinted(glass(1, 0), 0.5f)});
  all.push_back({"coloured glass of index 1", tinted(glass(1, 0.3f, 1), 0.5f)});
  all.push_back({"glossiness of 1", glossy(0)});
  return all;
}

}  // namespace etendue::test
