// Every texture of the extensions is read from its channel with its encoding and multiplied by its factor.
#include <gtest/gtest.h>

#include "support/gltf_cases.h"

namespace etendue::test {
namespace {

// One texel with four different bytes.
std::vector<Texture> texel() {
  auto image = std::make_shared<image::Image>();
  image->width = image->height = 1;
  image->channels = 4;
  image->type = image::PixelType::byte8;
  image->bytes = {51, 102, 153, 204};
  Texture texture;
  texture.image = image;
  return {texture};
}
constexpr float kR = 0.2f, kG = 0.4f, kA = 0.8f;
Rgb decoded() { return {srgb_to_linear(0.2f), srgb_to_linear(0.4f), srgb_to_linear(0.6f)}; }

// The textured material equals the material with the corresponding constant factors.
void expect_same(const Material& textured, const Material& plain, const std::string& name) {
  const std::vector<Texture> textures = texel();
  const SurfaceMaterial surface(textured, textures);
  EXPECT_TRUE(surface.has_textures) << name;
  AllLobes<Rgb> lobes;
  add_lobes(surface, {}, lobes);
  const auto expected = lobes_of(plain);
  Random random(7);
  for (int i = 0; i < 200; ++i) {
    const Vec3 o = random.any_direction(), wi = random.any_direction();
    const Rgb a = lobes.eval(o, wi, TransportMode::radiance), b = expected.eval(o, wi, TransportMode::radiance);
    for (int k = 0; k < 3; ++k) ASSERT_NEAR(a[k], b[k], 1e-3f * (1e-3f + b[k])) << name;
  }
}

struct Lookup {
  const char* name;
  TextureUse Material::*use;
  void (*with_factor)(Material&);
  void (*with_product)(Material&);
};

const Lookup kLookups[] = {
    {"clearcoat: R", &Material::clearcoat_texture, [](Material& m) { m.clearcoat = 0.5f; },
     [](Material& m) { m.clearcoat = 0.5f * kR; }},
    {"clearcoat roughness: G", &Material::clearcoat_roughness_texture,
     [](Material& m) { m.clearcoat = 1, m.clearcoat_roughness = 0.9f; },
     [](Material& m) { m.clearcoat = 1, m.clearcoat_roughness = 0.9f * kG; }},
    {"sheen colour: RGB, sRGB", &Material::sheen_color_texture, [](Material& m) { m.sheen_color = Rgb(0.5f); },
     [](Material& m) { m.sheen_color = decoded() * 0.5f; }},
    {"sheen roughness: A", &Material::sheen_roughness_texture,
     [](Material& m) { m.sheen_color = Rgb(1), m.sheen_roughness = 0.9f; },
     [](Material& m) { m.sheen_color = Rgb(1), m.sheen_roughness = 0.9f * kA; }},
    {"iridescence: R", &Material::iridescence_texture, [](Material& m) { m.iridescence = 0.9f; },
     [](Material& m) { m.iridescence = 0.9f * kR; }},
    {"iridescence thickness: G, from minimum to maximum", &Material::iridescence_thickness_texture,
     [](Material& m) { m.iridescence = 1, m.iridescence_thickness_min = 200, m.iridescence_thickness_max = 700; },
     [](Material& m) { m.iridescence = 1, m.iridescence_thickness_max = 200 + 500 * kG; }},
    {"iridescence thickness: the minimum may exceed the maximum", &Material::iridescence_thickness_texture,
     [](Material& m) { m.iridescence = 1, m.iridescence_thickness_min = 700, m.iridescence_thickness_max = 200; },
     [](Material& m) { m.iridescence = 1, m.iridescence_thickness_max = 700 - 500 * kG; }},
    {"diffuse transmission: A", &Material::diffuse_transmission_texture,
     [](Material& m) { m.diffuse_transmission = 0.9f; }, [](Material& m) { m.diffuse_transmission = 0.9f * kA; }},
    {"diffuse transmission colour: RGB, sRGB", &Material::diffuse_transmission_color_texture,
     [](Material& m) { m.diffuse_transmission = 0.9f, m.diffuse_transmission_color = Rgb(0.5f); },
     [](Material& m) { m.diffuse_transmission = 0.9f, m.diffuse_transmission_color = decoded() * 0.5f; }},
    {"specular and glossiness: RGB in sRGB", &Material::specular_color_texture,
     [](Material& m) { m.specular_glossiness = true, m.specular_color = Rgb(0.5f); },
     [](Material& m) { m.specular_glossiness = true, m.specular_color = decoded() * 0.5f; }},
    {"specular and glossiness: A is glossiness", &Material::metallic_roughness_texture,
     [](Material& m) { m.specular_glossiness = true, m.roughness = 1 - 0.5f; },
     [](Material& m) { m.specular_glossiness = true, m.roughness = 1 - 0.5f * kA; }},
};

TEST(GltfTextures, AreReadFromTheirChannels) {
  for (const Lookup& lookup : kLookups)
    for (const float metallic : {0.0f, 0.6f}) {
      Material textured;
      textured.base_color = {0.7f, 0.5f, 0.3f};
      textured.metallic = metallic;
      textured.roughness = 0.6f;
      Material plain = textured;
      lookup.with_factor(textured);
      lookup.with_product(plain);
      (textured.*lookup.use).texture = 0;
      expect_same(textured, plain, lookup.name);
    }
}

// Each texture has its own transform and set of texture coordinates.
TEST(GltfTextures, HaveIndependentTransforms) {
  auto image = std::make_shared<image::Image>();
  image->width = 2;
  image->height = 1;
  image->channels = 1;
  image->type = image::PixelType::byte8;
  image->bytes = {0, 255};
  Texture texture;
  texture.image = image;
  texture.nearest = true;
  Material m;
  m.metallic = 0;
  m.specular = 0;
  m.base_color = Rgb(1);
  m.clearcoat = 1;
  m.clearcoat_roughness = 1;
  m.clearcoat_texture.texture = 0;
  m.clearcoat_texture.uv_set = 1;
  m.clearcoat_texture.offset = {0.5f, 0};
  TexturePoint point;
  point.uv[0] = {0.75f, 0.5f};
  point.uv[1] = {0.25f, 0.5f};
  AllLobes<Rgb> lobes;
  add_lobes(SurfaceMaterial(m, {texture}), point, lobes);
  EXPECT_EQ(lobes.size(), 2) << "shifted by half an image, the second set samples the coat";
  m.clearcoat_texture.offset = {0, 0};
  lobes.clear();
  add_lobes(SurfaceMaterial(m, {texture}), point, lobes);
  EXPECT_EQ(lobes.size(), 1);
}

// The coat has its own normal map and is not affected by that of the base.
TEST(GltfTextures, CoatHasItsOwnNormal) {
  const std::vector<Texture> textures = texel();
  Material m;
  m.clearcoat = 1;
  m.normal_texture.texture = 0;
  SurfaceMaterial surface(m, textures);
  EXPECT_TRUE(surface.has_coat_normal);
  EXPECT_EQ(surface.coat_normal_at({}), Vec3(0, 0, 1));
  m.clearcoat_normal_texture.texture = 0;
  m.clearcoat_normal_scale = 0.5f;
  surface = SurfaceMaterial(m, textures);
  const Vec3 expected = glm::normalize(Vec3((2 * kR - 1) * 0.5f, (2 * kG - 1) * 0.5f, 0.2f));
  EXPECT_LT(glm::length(surface.coat_normal_at({}) - expected), 1e-3f);
  m.normal_texture.texture = m.clearcoat_normal_texture.texture = -1;
  EXPECT_FALSE(SurfaceMaterial(m, textures).has_coat_normal);
}

}  // namespace
}  // namespace etendue::test
