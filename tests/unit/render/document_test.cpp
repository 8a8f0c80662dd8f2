// New documents: additions to a scene without light or camera.
#include "render/document.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace etendue::render {
namespace {

// A file with one material and no geometry.
Result<Document> opened(const std::string& material) {
  const auto file = std::filesystem::temp_directory_path() / ("etendue-lit-" + std::to_string(::getpid()) + ".gltf");
  std::ofstream(file)
      << R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_materials_emissive_strength"],"scenes":[{}],)"
      << R"("materials":[)" << material << "]}";
  auto document = new_document(file.string());
  std::filesystem::remove(file);
  return document;
}

TEST(NewDocument, AWeakEmitterIsNoLightSource) {
  for (const char* material : {"{}", R"({"emissiveFactor":[1,1,1]})"}) {
    const auto document = opened(material);
    ASSERT_TRUE(document) << document.error().message;
    EXPECT_FALSE(document->scene->environment.black()) << material;
    ASSERT_FALSE(document->scene->warnings.empty());
    EXPECT_NE(document->scene->warnings.back().find("neutral environment"), std::string::npos);
  }
}

TEST(NewDocument, AStrongEmitterIsALightSource) {
  const auto document =
      opened(R"({"emissiveFactor":[1,1,1],"extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":5}}})");
  ASSERT_TRUE(document) << document.error().message;
  EXPECT_TRUE(document->scene->environment.black());
  EXPECT_TRUE(new_document("cornell")->scene->environment.black());
}

}  // namespace
}  // namespace etendue::render
