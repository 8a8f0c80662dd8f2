// KHR_materials_variants: import and selection.
#include "render/document.h"
#include "scene/compiled_scene.h"
#include "scene/variants.h"
#include "unit/scene/gltf_builder.h"

namespace etendue::test {
namespace {

// Three triangles: both variants change the first, the second variant changes the second, and none changes the third.
Gltf shop() {
  Gltf gltf;
  const auto mapping = [](int material, const json& variants) {
    return json{{"material", material}, {"variants", variants}};
  };
  gltf.triangle()["material"] = 0;
  gltf.root["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"] = {mapping(1, {0}),
                                                                                                 mapping(2, {1})};
  gltf.triangle()["extensions"]["KHR_materials_variants"]["mappings"] = json::array({mapping(2, {1})});
  gltf.triangle()["material"] = 1;
  for (const char* name : {"red", "green", "blue"}) gltf.root["materials"].push_back({{"name", name}});
  gltf.root["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "spring"}}, {{"name", "autumn"}}};
  gltf.root["extensionsUsed"] = {"KHR_materials_variants"};
  return gltf;
}

std::vector<int> materials_in_use(const scene::Scene& scene) {
  std::vector<int> materials;
  for (const auto& primitive : scene.meshes[0].primitives) materials.push_back(primitive.material);
  return materials;
}

class Variants : public GltfTest {};

TEST_F(Variants, AreImportedAndSelected) {
  Gltf gltf = shop();
  auto scene = opened(gltf);
  EXPECT_EQ(all(scene.warnings) + all(scene.unsupported), "");
  EXPECT_EQ(scene.variants, (std::vector<std::string>{"spring", "autumn"}));
  EXPECT_EQ(scene.variant, -1);
  const std::vector<int> own{0, 3, 1}, spring{1, 3, 1}, autumn{2, 2, 1};  // 3 is the default material
  EXPECT_EQ(materials_in_use(scene), own);
  scene::select_variant(scene, 0);
  EXPECT_EQ(materials_in_use(scene), spring);
  scene::select_variant(scene, 1);
  EXPECT_EQ(materials_in_use(scene), autumn);
  scene::select_variant(scene, -1);
  EXPECT_EQ(materials_in_use(scene), own);
}

TEST_F(Variants, AreAParameterOfTheScene) {
  Gltf gltf = shop();
  const auto document = render::new_document(write("shop.glb", gltf.glb()).string());
  ASSERT_TRUE(document);
  EXPECT_EQ(std::get<std::string>(*render::get(*document, "scene.variant")), "file's own");
  const auto autumn = render::with_text(*document, "scene.variant", "autumn");
  ASSERT_TRUE(autumn) << autumn.error().message;
  EXPECT_EQ(std::get<std::string>(*render::get(*autumn, "scene.variant")), "autumn");
  const auto before = scene::compile(document->scene, document->camera, nullptr);
  const auto after = scene::compile(autumn->scene, autumn->camera, before);
  EXPECT_EQ(before->instances()[0].material, 0U);
  EXPECT_EQ(after->instances()[0].material, 2U) << "the selection reaches the compiled scene";
  const auto again = render::document_from_state(render::state_json(*autumn, 1), "snapshot");
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(again->scene->variant, 1) << "a saved state keeps it";
  const auto wrong = render::with_text(*document, "scene.variant", "winter");
  ASSERT_FALSE(wrong);
  EXPECT_NE(wrong.error().message.find("autumn"), std::string::npos) << wrong.error().message;
}

TEST_F(Variants, ASceneWithoutVariantsHasNoParameter) {
  Gltf gltf;
  gltf.triangle();
  const auto document = render::new_document(write("plain.glb", gltf.glb()).string());
  EXPECT_FALSE(render::get(*document, "scene.variant"));
}

TEST_F(Variants, LabelsAreUnique) {
  scene::Scene scene;
  scene.variants = {"a", "a", "", "file's own", "a 2"};
  EXPECT_EQ(scene::variant_labels(scene),
            (std::vector<std::string>{"file's own", "a", "a 2", "variant", "file's own 2", "a 2 2"}));
}

// Tangents are generated at import, so the requirements of all variants count.
TEST_F(Variants, MeshesHaveTheTangentsThatVariantsNeed) {
  Gltf gltf;
  gltf.square()["material"] = 0;
  gltf.root["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"] = {
      {{"material", 1}, {"variants", {0}}}};
  gltf.root["materials"] = {json::object(), {{"normalTexture", {{"index", 0}}}}};
  gltf.root["textures"] = json::array({json::object()});
  gltf.root["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "rough"}}};
  EXPECT_EQ(mesh_of(opened(gltf))->tangents.size(), 4U);
}

// tinygltf asserts that values whose members are read are objects.
TEST_F(Variants, ValuesOfOtherTypesAreNoObjects) {
  Gltf numbers = shop();
  numbers.root["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"] = {1, 2};
  EXPECT_NE(error_of(numbers).find("KHR_materials_variants.mappings[0].material"), std::string::npos);
  Gltf names = shop();
  names.root["extensions"]["KHR_materials_variants"]["variants"] = {5, "x"};
  EXPECT_EQ(opened(names).variants, (std::vector<std::string>{"", ""}));
}

TEST_F(Variants, InvalidReferencesAreRejected) {
  const auto broken = [](const json& mapping) {
    Gltf gltf = shop();
    gltf.root["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]["mappings"][1] = mapping;
    return gltf;
  };
  const std::string where = "meshes[0].primitives[0].extensions.KHR_materials_variants.mappings[1].";
  Gltf material = broken({{"material", 7}, {"variants", {0}}}), variant = broken({{"material", 1}, {"variants", {2}}}),
       no_index = broken({{"material", 1}, {"variants", {-1}}});
  EXPECT_EQ(error_of(material), where + "material: refers to materials[7], which does not exist; the file has 3");
  EXPECT_EQ(error_of(variant), where + "variants[0]: refers to variants[2], which does not exist; the file has 2");
  EXPECT_TRUE(error_of(no_index).starts_with(where + "variants[0]")) << error_of(no_index);
}

}  // namespace
}  // namespace etendue::test
