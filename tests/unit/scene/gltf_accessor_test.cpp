// Accessors with all component types, layouts and sparse values.
#include "unit/scene/gltf_builder.h"

namespace etendue::test {
namespace {

class Accessors : public GltfTest {
 protected:
  const std::vector<Vec3> corners_{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
};

TEST_F(Accessors, PackedFloats) {
  Gltf gltf;
  gltf.triangle();
  const auto scene = opened(gltf);
  EXPECT_EQ(mesh_of(scene)->positions, corners_);
  EXPECT_EQ(mesh_of(scene)->triangles, (std::vector<Triangle>{{0, 1, 2}}));
  EXPECT_GT(mesh_of(scene)->positions.capacity(), corners_.size()) << "Embree reads 16 bytes at the last vertex";
  EXPECT_EQ(all(scene.warnings), "");
}

TEST_F(Accessors, InterleavedWithOffsets) {
  struct Vertex {
    Vec3 position, normal;
    Vec2 uv;
  };
  std::vector<Vertex> vertices;
  for (const Vec3& p : corners_) vertices.push_back({p, {0, 0, 1}, {p.x, p.y}});
  Gltf gltf;
  const int view = gltf.view(vertices.data(), vertices.size() * sizeof(Vertex), sizeof(Vertex));
  const int position = gltf.accessor(view, kFloat, "VEC3", 3), normal = gltf.accessor(view, kFloat, "VEC3", 3);
  const int uv = gltf.accessor(view, kFloat, "VEC2", 3);
  gltf.root["accessors"][normal]["byteOffset"] = 12;
  gltf.root["accessors"][uv]["byteOffset"] = 24;
  gltf.primitive({{"POSITION", position}, {"NORMAL", normal}, {"TEXCOORD_0", uv}});
  const auto mesh = mesh_of(opened(gltf));
  EXPECT_EQ(mesh->positions, corners_);
  EXPECT_EQ(mesh->normals, std::vector<Vec3>(3, Vec3(0, 0, 1)));
  EXPECT_EQ(mesh->uvs[0], (std::vector<Vec2>{{0, 0}, {1, 0}, {0, 1}}));
}

TEST_F(Accessors, IndicesOfAllSizes) {
  const std::vector<uint8_t> bytes{2, 1, 0};
  const std::vector<uint16_t> shorts{2, 1, 0};
  const std::vector<uint32_t> words{2, 1, 0};
  Gltf gltf;
  const int position = gltf.vec3(corners_);
  gltf.primitive({{"POSITION", position}}, gltf.accessor(gltf.view(bytes), kUByte, "SCALAR", 3));
  gltf.primitive({{"POSITION", position}}, gltf.accessor(gltf.view(shorts), kUShort, "SCALAR", 3));
  gltf.primitive({{"POSITION", position}}, gltf.accessor(gltf.view(words), kUInt, "SCALAR", 3));
  const auto scene = opened(gltf);
  for (size_t p = 0; p < 3; ++p) EXPECT_EQ(mesh_of(scene, p)->triangles, (std::vector<Triangle>{{2, 1, 0}}));
}

TEST_F(Accessors, SparseValuesReplaceOthers) {
  Gltf gltf;
  const int position = gltf.vec3({{0, 0, 0}, {9, 9, 9}, {0, 1, 0}});
  const int index = gltf.view(std::vector<uint8_t>{1}), value = gltf.view(std::vector<Vec3>{{1, 0, 0}});
  gltf.root["accessors"][position]["sparse"] = {{"count", 1},
                                                {"indices", {{"bufferView", index}, {"componentType", kUByte}}},
                                                {"values", {{"bufferView", value}}}};
  gltf.primitive({{"POSITION", position}});
  EXPECT_EQ(mesh_of(opened(gltf))->positions, corners_);
}

TEST_F(Accessors, SparseWithoutViewStartsFromZero) {
  Gltf gltf;
  const int position = gltf.accessor(-1, kFloat, "VEC3", 3);
  const int index = gltf.view(std::vector<uint16_t>{1, 2}), value = gltf.view(std::vector<Vec3>{{1, 0, 0}, {0, 1, 0}});
  gltf.root["accessors"][position]["sparse"] = {{"count", 2},
                                                {"indices", {{"bufferView", index}, {"componentType", kUShort}}},
                                                {"values", {{"bufferView", value}}}};
  gltf.primitive({{"POSITION", position}});
  EXPECT_EQ(mesh_of(opened(gltf))->positions, corners_);
}

TEST_F(Accessors, QuantisedAttributes) {
  Gltf gltf;
  gltf.root["extensionsUsed"] = gltf.root["extensionsRequired"] = {"KHR_mesh_quantization"};
  struct Corner {
    int16_t x, y, z, pad;
  };
  const std::vector<Corner> corners{{0, 0, 0, 0}, {32767, 0, 0, 0}, {0, -32768, 0, 0}};
  struct Normal {
    int8_t x, y, z, pad;
  };
  const std::vector<Normal> normals(3, Normal{0, 0, -127, 0});
  const std::vector<std::array<uint16_t, 2>> uvs{{0, 0}, {3, 0}, {0, 65535}};
  const int position = gltf.accessor(gltf.view(corners.data(), 24, 8), kShort, "VEC3", 3, true);
  const int normal = gltf.accessor(gltf.view(normals.data(), 12, 4), kByte, "VEC3", 3, true);
  const int uv = gltf.accessor(gltf.view(uvs.data(), 12, 4), kUShort, "VEC2", 3);
  gltf.primitive({{"POSITION", position}, {"NORMAL", normal}, {"TEXCOORD_0", uv}});
  const auto scene = opened(gltf);
  const auto mesh = mesh_of(scene);
  EXPECT_EQ(mesh->positions, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, -1, 0}})) << "-32768 is -1 as well";
  EXPECT_EQ(mesh->normals[0], Vec3(0, 0, -1));
  EXPECT_EQ(mesh->uvs[0][1], Vec2(3, 0)) << "integers that are not normalised keep their values";
  EXPECT_EQ(mesh->uvs[0][2], Vec2(0, 65535));
  EXPECT_EQ(all(scene.warnings), "");
}

TEST_F(Accessors, ColoursOfAllKinds) {
  Gltf gltf;
  const std::vector<std::array<uint8_t, 4>> bytes(3, {255, 0, 51, 102});
  const std::vector<std::array<uint16_t, 4>> shorts(3, {65535, 0, 13107, 26214});
  const int position = gltf.vec3(corners_);
  gltf.primitive({{"POSITION", position}, {"COLOR_0", gltf.accessor(gltf.view(bytes), kUByte, "VEC4", 3, true)}});
  gltf.primitive({{"POSITION", position}, {"COLOR_0", gltf.accessor(gltf.view(shorts), kUShort, "VEC4", 3, true)}});
  gltf.primitive({{"POSITION", position}, {"COLOR_0", gltf.vec3(std::vector<Vec3>(3, Vec3(1, 0, 0.2f)))}});
  gltf.primitive({{"POSITION", position}, {"COLOR_0", gltf.vec4(std::vector<Vec4>(3, Vec4(7, -1, 0.2f, 0.4f)))}});
  const auto scene = opened(gltf);
  for (const size_t p : {size_t{0}, size_t{1}, size_t{3}}) {
    const Vec4 c = mesh_of(scene, p)->colors.at(1);
    EXPECT_NEAR(glm::distance(c, Vec4(1, 0, 0.2f, 0.4f)), 0, 1e-6f) << p;
  }
  EXPECT_EQ(mesh_of(scene, 2)->colors.at(1), Vec4(1, 0, 0.2f, 1)) << "colours with three components are opaque";
}

TEST_F(Accessors, UnusedVerticesAreRemoved) {
  Gltf gltf;
  std::vector<Vec3> many(100);
  for (size_t i = 0; i < many.size(); ++i) many[i] = Vec3(static_cast<float>(i), static_cast<float>(i * i), 0);
  std::vector<Vec2> uvs;
  for (const Vec3& p : many) uvs.emplace_back(p.x, 0);
  const json attributes = {{"POSITION", gltf.vec3(many)}, {"TEXCOORD_0", gltf.vec2(uvs)}};
  gltf.primitive(attributes, gltf.indices({7, 50, 90}));
  gltf.primitive(attributes, gltf.indices({90, 91, 7}));
  const auto scene = opened(gltf);
  EXPECT_EQ(mesh_of(scene, 0)->positions, (std::vector<Vec3>{many[7], many[50], many[90]}));
  EXPECT_EQ(mesh_of(scene, 1)->triangles, (std::vector<Triangle>{{1, 2, 0}}));
  EXPECT_EQ(mesh_of(scene, 1)->uvs[0], (std::vector<Vec2>{{7, 0}, {90, 0}, {91, 0}}));
}

TEST_F(Accessors, EqualPrimitivesShareTheirMesh) {
  Gltf gltf;
  gltf.root["materials"] = {{{"name", "a"}}, {{"name", "b"}}};
  gltf.triangle()["material"] = 0;
  json copy = gltf.root["meshes"][0]["primitives"][0];
  copy["material"] = 1;
  gltf.root["meshes"].push_back({{"primitives", {copy}}});
  const auto scene = opened(gltf);
  EXPECT_EQ(scene.meshes[0].primitives[0].mesh, scene.meshes[1].primitives[0].mesh);
  EXPECT_EQ(scene.meshes[1].primitives[0].material, 1);
}

TEST_F(Accessors, MissingNormalizedFlagIsRepairedWithAWarning) {
  Gltf gltf;
  const int color =
      gltf.accessor(gltf.view(std::vector<std::array<uint8_t, 4>>(3, {255, 0, 51, 255})), kUByte, "VEC4", 3);
  gltf.triangle()["attributes"]["COLOR_0"] = color;
  const auto scene = opened(gltf);
  EXPECT_EQ(mesh_of(scene)->colors[0].x, 1);
  EXPECT_TRUE(
      warns(scene,
            "meshes[0].primitives[0].attributes.COLOR_0: accessor 0 is VEC4 of unsigned bytes; it is read as if "
            "normalized were true"))
      << all(scene.warnings);
}

}  // namespace
}  // namespace etendue::test
