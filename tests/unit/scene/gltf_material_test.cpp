// Materials, their extensions and their textures.
#include "unit/image/file_bytes.h"
#include "unit/scene/gltf_builder.h"

namespace etendue::test {
namespace {

class Materials : public GltfTest {
 protected:
  static Gltf with(const json& material) {
    Gltf gltf;
    gltf.triangle()["material"] = 0;
    gltf.root["materials"] = json::array({material});
    gltf.root["textures"] = {{{"source", 0}}, {{"source", 0}}};
    gltf.root["images"] = {{{"uri", "none.png"}}};
    return gltf;
  }
  Material material(const json& description) {
    Gltf gltf = with(description);
    const auto scene = opened(gltf);
    return scene.materials.empty() ? Material{} : scene.materials[0];
  }
  Material extended(const char* extension, const json& members) {
    return material({{"extensions", {{extension, members}}}});
  }
};

TEST_F(Materials, DefaultsFollowTheSpecification) {
  const Material m = material(json::object());
  EXPECT_EQ(m, Material{});
  EXPECT_EQ(m.metallic, 1);
  EXPECT_EQ(m.roughness, 1);
  Gltf none;
  none.triangle();
  const auto scene = opened(none);
  ASSERT_EQ(scene.materials.size(), 1U);
  EXPECT_EQ(scene.meshes[0].primitives[0].material, 0) << "the last material is the default";
}

TEST_F(Materials, Factors) {
  const Material m = material({{"name", "paint"},
                               {"pbrMetallicRoughness",
                                {{"baseColorFactor", {0.1, 0.2, 0.3, 0.4}},
                                 {"metallicFactor", 0.5},
                                 {"roughnessFactor", 0.6},
                                 {"baseColorTexture", {{"index", 1}, {"texCoord", 1}}},
                                 {"metallicRoughnessTexture", {{"index", 0}}}}},
                               {"normalTexture", {{"index", 1}, {"scale", -0.5}}},
                               {"emissiveFactor", {1, 0.5, 0}},
                               {"emissiveTexture", {{"index", 0}}},
                               {"alphaMode", "MASK"},
                               {"alphaCutoff", 0.25},
                               {"doubleSided", true}});
  EXPECT_EQ(m.name, "paint");
  EXPECT_EQ(m.base_color, Rgb(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(m.alpha, 0.4f);
  EXPECT_EQ(m.metallic, 0.5f);
  EXPECT_EQ(m.roughness, 0.6f);
  EXPECT_EQ(m.base_color_texture.texture, 1);
  EXPECT_EQ(m.base_color_texture.uv_set, 1);
  EXPECT_EQ(m.metallic_roughness_texture.texture, 0);
  EXPECT_EQ(m.normal_texture.texture, 1);
  EXPECT_EQ(m.normal_scale, -0.5f);
  EXPECT_EQ(m.emission, Rgb(1, 0.5f, 0));
  EXPECT_EQ(m.emission_texture.texture, 0);
  EXPECT_EQ(m.alpha_mode, AlphaMode::mask);
  EXPECT_EQ(m.alpha_cutoff, 0.25f);
  EXPECT_TRUE(m.double_sided);
  EXPECT_EQ(material({{"alphaMode", "BLEND"}}).alpha_mode, AlphaMode::blend);
}

TEST_F(Materials, EmissiveStrength) {
  const Material m = material({{"emissiveFactor", {1, 0.5, 0}},
                               {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 8}}}}}});
  EXPECT_EQ(m.emission, Rgb(8, 4, 0));
}

TEST_F(Materials, Unlit) { EXPECT_TRUE(extended("KHR_materials_unlit", json::object()).unlit); }

TEST_F(Materials, Ior) {
  EXPECT_EQ(extended("KHR_materials_ior", {{"ior", 1.33}}).ior, 1.33f);
  EXPECT_EQ(extended("KHR_materials_ior", json::object()).ior, 1.5f);
  EXPECT_EQ(extended("KHR_materials_ior", {{"ior", 0}}).ior, 0) << "0 means a Fresnel term of 1";
  EXPECT_EQ(extended("KHR_materials_ior", {{"ior", 0.5}}).ior, 1);
}

TEST_F(Materials, Specular) {
  const Material m = extended("KHR_materials_specular", {{"specularFactor", 0.25},
                                                         {"specularColorFactor", {2, 1, 0.5}},
                                                         {"specularTexture", {{"index", 0}}},
                                                         {"specularColorTexture", {{"index", 1}, {"texCoord", 1}}}});
  EXPECT_EQ(m.specular, 0.25f);
  EXPECT_EQ(m.specular_color, Rgb(2, 1, 0.5f));
  EXPECT_EQ(m.specular_texture.texture, 0);
  EXPECT_EQ(m.specular_color_texture.texture, 1);
  EXPECT_EQ(m.specular_color_texture.uv_set, 1);
}

TEST_F(Materials, TransmissionAndVolume) {
  const Material thin =
      extended("KHR_materials_transmission", {{"transmissionFactor", 0.75}, {"transmissionTexture", {{"index", 1}}}});
  EXPECT_EQ(thin.transmission, 0.75f);
  EXPECT_EQ(thin.transmission_texture.texture, 1);
  EXPECT_FALSE(thin.is_solid());
  const Material solid =
      material({{"extensions",
                 {{"KHR_materials_transmission", {{"transmissionFactor", 1}}},
                  {"KHR_materials_volume",
                   {{"thicknessFactor", 2}, {"attenuationDistance", 0.5}, {"attenuationColor", {0.1, 0.2, 1}}}}}}});
  EXPECT_TRUE(solid.is_solid());
  EXPECT_EQ(solid.attenuation_distance, 0.5f);
  EXPECT_EQ(solid.attenuation_color, Rgb(0.1f, 0.2f, 1));
  EXPECT_EQ(extended("KHR_materials_volume", {{"thicknessFactor", 1}}).attenuation_distance, kInfinity);
}

TEST_F(Materials, Anisotropy) {
  const Material m = extended("KHR_materials_anisotropy", {{"anisotropyStrength", 0.5},
                                                           {"anisotropyRotation", 1.25},
                                                           {"anisotropyTexture", {{"index", 1}, {"texCoord", 1}}}});
  EXPECT_EQ(m.anisotropy, 0.5f);
  EXPECT_EQ(m.anisotropy_rotation, 1.25f);
  EXPECT_EQ(m.anisotropy_texture.texture, 1);
  EXPECT_EQ(m.anisotropy_texture.uv_set, 1);
}

// A texture reference with all members.
json moved_texture(int index) {
  return {{"index", index},
          {"texCoord", 1},
          {"extensions", {{"KHR_texture_transform", {{"offset", {0.5, 1}}, {"rotation", 0.25}, {"scale", {2, 3}}}}}}};
}

void expect_moved(const TextureUse& use, int index) {
  TextureUse moved;
  moved.texture = index;
  moved.uv_set = 1;
  moved.offset = Vec2(0.5f, 1);
  moved.scale = Vec2(2, 3);
  moved.rotation = 0.25f;
  EXPECT_EQ(use, moved);
}

TEST_F(Materials, Clearcoat) {
  json normal = moved_texture(0);
  normal["scale"] = 0.75;
  const Material m = extended("KHR_materials_clearcoat", {{"clearcoatFactor", 0.5},
                                                          {"clearcoatRoughnessFactor", 0.25},
                                                          {"clearcoatTexture", moved_texture(0)},
                                                          {"clearcoatRoughnessTexture", moved_texture(1)},
                                                          {"clearcoatNormalTexture", normal}});
  EXPECT_EQ(m.clearcoat, 0.5f);
  EXPECT_EQ(m.clearcoat_roughness, 0.25f);
  EXPECT_EQ(m.clearcoat_normal_scale, 0.75f);
  expect_moved(m.clearcoat_texture, 0);
  expect_moved(m.clearcoat_roughness_texture, 1);
  expect_moved(m.clearcoat_normal_texture, 0);
}

TEST_F(Materials, Sheen) {
  const Material m = extended("KHR_materials_sheen", {{"sheenColorFactor", {0.1, 0.2, 0.3}},
                                                      {"sheenRoughnessFactor", 0.5},
                                                      {"sheenColorTexture", moved_texture(0)},
                                                      {"sheenRoughnessTexture", moved_texture(1)}});
  EXPECT_EQ(m.sheen_color, Rgb(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(m.sheen_roughness, 0.5f);
  expect_moved(m.sheen_color_texture, 0);
  expect_moved(m.sheen_roughness_texture, 1);
}

TEST_F(Materials, Iridescence) {
  const Material m = extended("KHR_materials_iridescence", {{"iridescenceFactor", 0.5},
                                                            {"iridescenceIor", 1.75},
                                                            {"iridescenceThicknessMinimum", 300},
                                                            {"iridescenceThicknessMaximum", 200},
                                                            {"iridescenceTexture", moved_texture(0)},
                                                            {"iridescenceThicknessTexture", moved_texture(1)}});
  EXPECT_EQ(m.iridescence, 0.5f);
  EXPECT_EQ(m.iridescence_ior, 1.75f);
  EXPECT_EQ(m.iridescence_thickness_min, 300) << "the minimum may exceed the maximum";
  EXPECT_EQ(m.iridescence_thickness_max, 200);
  expect_moved(m.iridescence_texture, 0);
  expect_moved(m.iridescence_thickness_texture, 1);
}

TEST_F(Materials, Dispersion) {
  const Material m = extended("KHR_materials_dispersion", {{"dispersion", 0.75}});
  EXPECT_EQ(m.dispersion, 0.75f);
  EXPECT_EQ(m.glass, Glass::none);
  EXPECT_EQ(extended("ETENDUE_transport", {{"glass", "n-bk7"}}).glass, Glass::n_bk7);
}

TEST_F(Materials, DiffuseTransmission) {
  const Material m =
      extended("KHR_materials_diffuse_transmission", {{"diffuseTransmissionFactor", 0.5},
                                                      {"diffuseTransmissionColorFactor", {0.1, 0.2, 0.3}},
                                                      {"diffuseTransmissionTexture", moved_texture(0)},
                                                      {"diffuseTransmissionColorTexture", moved_texture(1)}});
  EXPECT_EQ(m.diffuse_transmission, 0.5f);
  EXPECT_EQ(m.diffuse_transmission_color, Rgb(0.1f, 0.2f, 0.3f));
  expect_moved(m.diffuse_transmission_texture, 0);
  expect_moved(m.diffuse_transmission_color_texture, 1);
}

TEST_F(Materials, SpecularGlossiness) {
  // The metallic-roughness values are a fallback for readers without the extension.
  const Material m = material({{"pbrMetallicRoughness", {{"baseColorFactor", {1, 0, 0, 1}}, {"metallicFactor", 1}}},
                               {"extensions",
                                {{"KHR_materials_pbrSpecularGlossiness",
                                  {{"diffuseFactor", {0.1, 0.2, 0.3, 0.4}},
                                   {"specularFactor", {0.5, 0.6, 0.7}},
                                   {"glossinessFactor", 0.75},
                                   {"diffuseTexture", moved_texture(0)},
                                   {"specularGlossinessTexture", moved_texture(1)}}}}}});
  EXPECT_TRUE(m.specular_glossiness);
  EXPECT_EQ(m.base_color, Rgb(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(m.alpha, 0.4f);
  EXPECT_EQ(m.specular_color, Rgb(0.5f, 0.6f, 0.7f));
  EXPECT_EQ(m.roughness, 0.25f);
  EXPECT_EQ(m.metallic, 0);
  expect_moved(m.base_color_texture, 0);
  expect_moved(m.specular_color_texture, 1);
  expect_moved(m.metallic_roughness_texture, 1);
  const Material usual = extended("KHR_materials_pbrSpecularGlossiness", json::object());
  EXPECT_EQ(usual.base_color, Rgb(1));
  EXPECT_EQ(usual.specular_color, Rgb(1));
  EXPECT_EQ(usual.roughness, 0) << "the default is a perfect mirror";
}

TEST_F(Materials, ValuesOutOfRangeAreRepairedWithAWarning) {
  Gltf gltf = with({{"extensions",
                     {{"KHR_materials_clearcoat", {{"clearcoatFactor", 2}, {"clearcoatRoughnessFactor", -1}}},
                      {"KHR_materials_sheen", {{"sheenColorFactor", {0, 1.5, 0}}}},
                      {"KHR_materials_iridescence", {{"iridescenceIor", 0.5}, {"iridescenceThicknessMinimum", -7}}},
                      {"KHR_materials_dispersion", {{"dispersion", -1}}},
                      {"ETENDUE_transport", {{"glass", "sugar"}}},
                      {"KHR_materials_diffuse_transmission", {{"diffuseTransmissionFactor", 3}}}}}});
  const auto scene = opened(gltf);
  const Material& m = scene.materials[0];
  EXPECT_EQ(m.clearcoat, 1);
  EXPECT_EQ(m.clearcoat_roughness, 0);
  EXPECT_EQ(m.sheen_color, Rgb(0, 1, 0));
  EXPECT_EQ(m.iridescence_ior, 1);
  EXPECT_EQ(m.iridescence_thickness_min, 0);
  EXPECT_EQ(m.diffuse_transmission, 1);
  EXPECT_EQ(m.dispersion, 0);
  EXPECT_EQ(m.glass, Glass::none);
  for (const char* text : {"materials[0]: clearcoatFactor is 2; it has to be between 0 and 1; 1 is used",
                           "materials[0]: clearcoatRoughnessFactor is -1;", "materials[0]: sheenColorFactor[1] is 1.5;",
                           "materials[0]: iridescenceIor is 0.5; it has to be at least 1; 1 is used",
                           "materials[0]: iridescenceThicknessMinimum is -7; it has to be at least 0",
                           "materials[0]: dispersion is -1; it has to be between 0 and 100; 0 is used",
                           "glass: 'sugar' is not an allowed value", "materials[0]: diffuseTransmissionFactor is 3;"})
    EXPECT_TRUE(warns(scene, text)) << text << "\n" << all(scene.warnings);
}

TEST_F(Materials, ExtensionsOfTheWrongTypeAreRejected) {
  for (const auto& [extension, member] :
       {std::pair("KHR_materials_clearcoat", "clearcoatFactor"), std::pair("KHR_materials_sheen", "sheenColorFactor"),
        std::pair("KHR_materials_pbrSpecularGlossiness", "diffuseFactor"),
        std::pair("KHR_materials_pbrSpecularGlossiness", "glossinessFactor")}) {
    Gltf gltf = with({{"extensions", {{extension, {{member, "much"}}}}}});
    EXPECT_NE(error_of(gltf).find(std::string(extension) + "." + member), std::string::npos) << error_of(gltf);
  }
}

TEST_F(Materials, TextureTransform) {
  const json transform = {{"offset", {0.5, -1}}, {"scale", {2, 3}}, {"rotation", 0.25}, {"texCoord", 1}};
  const auto use = material({{"emissiveTexture",
                              {{"index", 0}, {"texCoord", 0}, {"extensions", {{"KHR_texture_transform", transform}}}}}})
                       .emission_texture;
  EXPECT_EQ(use.offset, Vec2(0.5f, -1));
  EXPECT_EQ(use.scale, Vec2(2, 3));
  EXPECT_EQ(use.rotation, 0.25f);
  EXPECT_EQ(use.uv_set, 1) << "the set of the transform takes precedence";
  // Inside another extension, without texCoord in the transform.
  const auto inner =
      extended("KHR_materials_specular",
               {{"specularTexture",
                 {{"index", 1}, {"texCoord", 1}, {"extensions", {{"KHR_texture_transform", {{"rotation", -1}}}}}}}})
          .specular_texture;
  EXPECT_EQ(inner.rotation, -1);
  EXPECT_EQ(inner.scale, Vec2(1));
  EXPECT_EQ(inner.uv_set, 1);
}

TEST_F(Materials, ThirdTextureCoordinateSet) {
  Gltf gltf = with({{"emissiveTexture", {{"index", 0}, {"texCoord", 2}}}});
  const auto scene = opened(gltf);
  EXPECT_EQ(scene.materials[0].emission_texture.uv_set, 0);
  EXPECT_TRUE(warns(scene, "materials[0]: emissiveTexture uses TEXCOORD_2"));
}

TEST_F(Materials, FactorsOutOfRange) {
  const Material m = material(
      {{"pbrMetallicRoughness", {{"baseColorFactor", {2, -1, 0.5, 7}}, {"metallicFactor", -3}, {"roughnessFactor", 9}}},
       {"emissiveFactor", {-1, 0, 3}},
       {"alphaMode", "GLOW"}});
  EXPECT_EQ(m.base_color, Rgb(1, 0, 0.5f));
  EXPECT_EQ(m.alpha, 1);
  EXPECT_EQ(m.metallic, 0);
  EXPECT_EQ(m.roughness, 1);
  EXPECT_EQ(m.emission, Rgb(0, 0, 3));
  EXPECT_EQ(m.alpha_mode, AlphaMode::opaque);
}

class Textures : public Materials {
 protected:
  // A PNG file with one row.
  static std::string png(const std::vector<uint8_t>& rgb) {
    return png_file(static_cast<uint32_t>(rgb.size() / 3), 8, kTrueColour, {std::string(rgb.begin(), rgb.end())});
  }
};

TEST_F(Textures, FromFileBufferViewAndDataUri) {
  const std::string picture = png({255, 0, 0, 0, 0, 255});
  write("red blue.png", picture);
  Gltf gltf = with({{"emissiveTexture", {{"index", 0}}}});
  const int view = gltf.view(picture.data(), picture.size());
  static constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string base64;
  for (size_t i = 0; i < picture.size(); i += 3) {
    uint32_t bits = 0;
    for (size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (i + k < picture.size() ? static_cast<uint8_t>(picture[i + k]) : 0U);
    for (size_t k = 0; k < 4; ++k) base64 += i + k > picture.size() ? '=' : kDigits[bits >> (18 - 6 * k) & 63];
  }
  gltf.root["images"] = {{{"uri", "red%20blue.png"}},
                         {{"bufferView", view}, {"mimeType", "image/png"}},
                         {{"uri", "data:image/png;base64," + base64}}};
  gltf.root["textures"] = {{{"source", 0}}, {{"source", 1}}, {{"source", 2}}, {{"source", 0}}};
  const auto scene = opened(gltf);
  EXPECT_EQ(all(scene.warnings), "");
  for (const Texture& texture : scene.textures) {
    ASSERT_TRUE(texture.image);
    EXPECT_EQ(texture.image->width, 2);
    EXPECT_EQ(texture.image->bytes, (std::vector<uint8_t>{255, 0, 0, 0, 0, 255}));
  }
  EXPECT_EQ(scene.textures[0].image, scene.textures[3].image) << "each image is decoded once";
}

TEST_F(Textures, Samplers) {
  Gltf gltf = with(json::object());
  gltf.root["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}},
                           {{"magFilter", 9729}, {"minFilter", 9984}}};
  gltf.root["textures"] = {
      {{"source", 0}, {"sampler", 0}, {"name", "first"}}, {{"source", 0}, {"sampler", 1}}, {{"source", 0}}};
  const auto scene = opened(gltf);
  EXPECT_EQ(scene.textures[0].wrap_u, Wrap::clamp);
  EXPECT_EQ(scene.textures[0].wrap_v, Wrap::mirror);
  EXPECT_TRUE(scene.textures[0].nearest);
  EXPECT_EQ(scene.textures[0].name, "first");
  for (const size_t t : {size_t{1}, size_t{2}}) {
    EXPECT_EQ(scene.textures[t].wrap_u, Wrap::repeat);
    EXPECT_FALSE(scene.textures[t].nearest);
  }
}

TEST_F(Textures, MissingImagesFallBackToFactors) {
  write("broken.png", png({1, 2, 3}).substr(0, 40));
  write("text.png", "no picture");
  Gltf gltf = with({{"emissiveTexture", {{"index", 0}}}});
  const int view = gltf.view(std::vector<uint8_t>(8));
  gltf.root["images"] = {
      {{"uri", "broken.png"}}, {{"uri", "text.png"}}, {{"uri", "https://example.com/a.png"}}, json::object(),
      {{"bufferView", view}},  {{"bufferView", 99}},  {{"uri", "data:image/png;base64,*"}}};
  gltf.root["textures"] = json::array();
  for (int i = 0; i < 7; ++i) gltf.root["textures"].push_back({{"source", i}});
  gltf.root["textures"].push_back(json::object());
  const auto scene = opened(gltf);
  for (const Texture& texture : scene.textures) EXPECT_FALSE(texture.image);
  for (const char* text :
       {"images[0] 'broken.png': ", "images[1] 'text.png', images[4]: unknown image format",
        "images[2] 'https://example.com/a.png': has a uri that is not a local file",
        "images[3]: has neither uri nor bufferView", "images[5]: bufferView 99 does not exist",
        "images[6] 'data:image/png...': has a malformed data URI", "textures[7]: has no image; constant factors"})
    EXPECT_TRUE(warns(scene, text)) << text << "\n" << all(scene.warnings);
}

TEST_F(Textures, InvalidBufferViewsOfImages) {
  Gltf gltf = with({{"emissiveTexture", {{"index", 0}}}});
  const int view = gltf.view(std::vector<uint8_t>(8));
  gltf.root["bufferViews"][view]["byteLength"] = 1 << 30;
  gltf.root["images"] = {{{"bufferView", view}, {"mimeType", "image/png"}}};
  const auto scene = opened(gltf);
  EXPECT_FALSE(scene.textures[0].image);
  EXPECT_TRUE(warns(scene, "images[0]: bufferView 1 ends at byte")) << all(scene.warnings);
}

TEST_F(Textures, WebpTakesPrecedence) {
  write("fallback.png", png({9, 9, 9}));
  write("better.png", png({7, 7, 7}));  // the format follows from the content, not from the file name
  Gltf gltf = with({{"emissiveTexture", {{"index", 0}}}});
  gltf.root["images"] = {{{"uri", "fallback.png"}}, {{"uri", "better.png"}}};
  gltf.root["textures"] = {{{"source", 0}, {"extensions", {{"EXT_texture_webp", {{"source", 1}}}}}}};
  gltf.root["extensionsRequired"] = {"EXT_texture_webp"};
  EXPECT_EQ(opened(gltf).textures[0].image->bytes, (std::vector<uint8_t>{7, 7, 7}));
}

// KTX2 is not supported: the extension is reported as ignored, and the PNG or JPEG fallback is used.
TEST_F(Textures, BasisUniversalFallsBack) {
  write("fallback.png", png({9, 9, 9}));
  Gltf gltf = with({{"emissiveTexture", {{"index", 0}}}});
  gltf.root["images"] = {{{"uri", "fallback.png"}}, {{"uri", "small.ktx2"}}};
  gltf.root["textures"] = {{{"source", 0}, {"extensions", {{"KHR_texture_basisu", {{"source", 1}}}}}},
                           {{"extensions", {{"KHR_texture_basisu", {{"source", 1}}}}}}};
  gltf.root["extensionsUsed"] = {"KHR_texture_basisu"};
  const auto scene = opened(gltf);
  EXPECT_EQ(scene.unsupported, std::vector<std::string>{"KHR_texture_basisu"});
  EXPECT_EQ(scene.textures[0].image->bytes, (std::vector<uint8_t>{9, 9, 9}));
  EXPECT_FALSE(scene.textures[1].image);
  EXPECT_TRUE(warns(
      scene, "KTX 2 (Basis Universal) is not supported; textures without an image in another format: 1; constant"));
  EXPECT_EQ(scene.warnings.size(), 1u) << all(scene.warnings);
}

}  // namespace
}  // namespace etendue::test
