// Primitives: topologies, repairs, and attributes that materials need.
#include "unit/scene/gltf_builder.h"

namespace etendue::test {
namespace {

class Meshes : public GltfTest {
 protected:
  static constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  const std::vector<Vec3> quad_{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};

  static Vec3 normal_of(const Mesh& mesh, const Triangle& t) {
    return glm::normalize(
        glm::cross(mesh.positions[t[1]] - mesh.positions[t[0]], mesh.positions[t[2]] - mesh.positions[t[0]]));
  }
};

TEST_F(Meshes, StripsAlternateTheWinding) {
  Gltf gltf;
  gltf.primitive({{"POSITION", gltf.vec3({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 2, 0}})}})["mode"] = 5;
  const auto mesh = mesh_of(opened(gltf));
  EXPECT_EQ(mesh->triangles, (std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}));
  for (const auto& t : mesh->triangles) EXPECT_EQ(normal_of(*mesh, t), Vec3(0, 0, 1));
}

TEST_F(Meshes, FansShareTheFirstVertex) {
  Gltf gltf;
  const int position = gltf.vec3({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  const int indices = gltf.indices({0, 1, 2, 3});
  gltf.primitive({{"POSITION", position}}, indices)["mode"] = 6;
  const auto mesh = mesh_of(opened(gltf));
  EXPECT_EQ(mesh->triangles, (std::vector<Triangle>{{1, 2, 0}, {2, 3, 0}}));
  for (const auto& t : mesh->triangles) EXPECT_EQ(normal_of(*mesh, t), Vec3(0, 0, 1));
}

TEST_F(Meshes, PointsAndLinesAreNotRendered) {
  const char* const names[] = {"points", "lines", "line loops", "line strips"};
  for (int mode = 0; mode < 4; ++mode) {
    Gltf gltf;
    gltf.triangle()["mode"] = mode;
    const auto scene = opened(gltf);
    EXPECT_TRUE(scene.meshes[0].primitives.empty());
    EXPECT_TRUE(warns(scene, std::string("meshes[0].primitives[0]: ") + names[mode] + " are not rendered"));
  }
}

TEST_F(Meshes, IncompleteTriangles) {
  Gltf gltf;
  gltf.primitive({{"POSITION", gltf.vec3(quad_)}});
  const auto scene = opened(gltf);
  EXPECT_EQ(mesh_of(scene)->triangles.size(), 1U);
  EXPECT_TRUE(warns(scene, "has 4 vertices; the last 1 cannot form a triangle"));
  Gltf two;
  two.primitive({{"POSITION", two.vec3({{0, 0, 0}, {1, 0, 0}})}});
  EXPECT_TRUE(opened(two).meshes[0].primitives.empty());
}

TEST_F(Meshes, TrianglesWithoutAreaAreDropped) {
  Gltf gltf;
  const int position = gltf.vec3({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {0, 0, 0}});
  gltf.primitive({{"POSITION", position}}, gltf.indices({0, 1, 2, 0, 1, 1, 0, 1, 3, 0, 4, 2}));
  const auto scene = opened(gltf);
  EXPECT_EQ(mesh_of(scene)->triangles, (std::vector<Triangle>{{0, 1, 2}}));
  EXPECT_TRUE(warns(scene, "meshes[0].primitives[0]: 3 triangles without area were dropped")) << all(scene.warnings);
}

TEST_F(Meshes, SmallTrianglesAreKept) {
  for (const float size : {1e-9f, 1e-6f, 1.0f, 1e6f, 5e8f}) {
    Gltf gltf;
    gltf.primitive({{"POSITION", gltf.vec3({{0, 0, 0}, {size, 0, 0}, {0, size * 1e-3f, 0}})}});
    EXPECT_EQ(mesh_of(opened(gltf))->triangles.size(), 1U) << size;
  }
}

TEST_F(Meshes, DuplicateTrianglesAreDropped) {
  Gltf gltf;
  // Duplicates with the same indices, with rotated indices, and with other indices of equal positions. A triangle with
  // the opposite winding is a different surface.
  std::vector<Vec3> corners = quad_;
  corners.insert(corners.end(), quad_.begin(), quad_.end());
  const int position = gltf.vec3(corners);
  gltf.primitive({{"POSITION", position}}, gltf.indices({0, 1, 2, 1, 2, 0, 4, 5, 6, 2, 1, 0, 1, 3, 2}));
  const auto scene = opened(gltf);
  EXPECT_EQ(mesh_of(scene)->triangles, (std::vector<Triangle>{{0, 1, 2}, {2, 1, 0}, {1, 3, 2}}));
  EXPECT_TRUE(warns(scene, "2 duplicate triangles were dropped")) << all(scene.warnings);
}

TEST_F(Meshes, PositionsThatAreNotFinite) {
  Gltf gltf;
  const int position = gltf.vec3({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {kNaN, 0, 0}, {kInfinity, 0, 0}});
  gltf.primitive({{"POSITION", position}}, gltf.indices({0, 1, 2, 0, 1, 3, 0, 4, 2}));
  const auto scene = opened(gltf);
  EXPECT_EQ(mesh_of(scene)->triangles.size(), 1U);
  EXPECT_TRUE(warns(scene, "2 triangles with positions that are not finite or beyond 1e9 m were dropped"));
  EXPECT_EQ(scene::world_bounds(scene).max, Vec3(1, 1, 0)) << "unused vertices do not affect the bounds";
}

TEST_F(Meshes, NormalsAreNormalisedOrReplaced) {
  Gltf gltf;
  const json attributes = {{"POSITION", gltf.vec3({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})},
                           {"NORMAL", gltf.vec3({{0, 0, 3}, {kNaN, 0, 1}, {0, 0, 0}})}};
  gltf.primitive(attributes);
  const auto scene = opened(gltf);
  EXPECT_EQ(mesh_of(scene)->normals, std::vector<Vec3>(3, Vec3(0, 0, 1)));
  EXPECT_TRUE(
      warns(scene, "2 normals that are zero or not finite were replaced by the mean of the adjacent triangles"));
}

TEST_F(Meshes, WithoutNormalsShadingIsFlat) {
  Gltf gltf;
  const int position = gltf.vec3({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  gltf.primitive({{"POSITION", position}, {"TANGENT", gltf.vec4(std::vector<Vec4>(3, Vec4(1, 0, 0, 1)))}});
  const auto mesh = mesh_of(opened(gltf));
  EXPECT_TRUE(mesh->normals.empty());
  EXPECT_TRUE(mesh->tangents.empty()) << "section 3.7.2.1: tangents without normals are ignored";
}

TEST_F(Meshes, CoordinatesAndColoursThatAreNotFinite) {
  Gltf gltf;
  const json attributes = {{"POSITION", gltf.vec3({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})},
                           {"TEXCOORD_1", gltf.vec2({{kNaN, 0}, {1, 1}, {0, 0}})},
                           {"COLOR_0", gltf.vec3({{kNaN, 0, 0}, {0, 1, 1}, {0, 0, 0}})}};
  gltf.primitive(attributes);
  const auto scene = opened(gltf);
  EXPECT_EQ(mesh_of(scene)->uvs[1][0], Vec2(0));
  EXPECT_EQ(mesh_of(scene)->colors[0], Vec4(1));
  EXPECT_TRUE(warns(scene, "TEXCOORD_1: 1 coordinates")) << all(scene.warnings);
  EXPECT_TRUE(warns(scene, "COLOR_0: 1 colours"));
}

class NormalMaps : public Meshes {
 protected:
  static void add_normal_map(Gltf& gltf, json use = {{"index", 0}}) {
    gltf.root["materials"] = {{{"normalTexture", std::move(use)}}};
    gltf.root["textures"] = json::array({json::object()});
    gltf.root["meshes"][0]["primitives"][0]["material"] = 0;
  }
};

TEST_F(NormalMaps, TangentsAreGeneratedForNormalMapsOnly) {
  Gltf gltf;
  gltf.square();
  EXPECT_TRUE(mesh_of(opened(gltf))->tangents.empty());
  add_normal_map(gltf);
  const auto mesh = mesh_of(opened(gltf));
  // u increases along x. y of the normal map points up in the image, opposite to v: handedness +1.
  ASSERT_EQ(mesh->tangents.size(), 4U);
  for (const Vec4& t : mesh->tangents) EXPECT_EQ(t, Vec4(1, 0, 0, 1));
}

TEST_F(NormalMaps, TangentsOfTheFileAreKept) {
  Gltf gltf;
  gltf.square()["attributes"]["TANGENT"] = gltf.vec4(std::vector<Vec4>(4, Vec4(0, 1, 0, -1)));
  add_normal_map(gltf);
  EXPECT_EQ(mesh_of(opened(gltf))->tangents, std::vector<Vec4>(4, Vec4(0, 1, 0, -1)));
}

TEST_F(NormalMaps, InvalidTangentsAreReplaced) {
  Gltf gltf;
  gltf.square()["attributes"]["TANGENT"] = gltf.vec4({{0, 1, 0, -1}, {0, 0, 0, 1}, {0, 1, 0, 1}, {0, 1, 0, 1}});
  add_normal_map(gltf);
  const auto scene = opened(gltf);
  EXPECT_EQ(mesh_of(scene)->tangents, std::vector<Vec4>(4, Vec4(1, 0, 0, 1)));
  EXPECT_TRUE(warns(scene, "TANGENT contains vectors that are zero or not finite; all tangents are ignored"));
}

TEST_F(NormalMaps, TangentsFollowTheTextureTransform) {
  Gltf gltf;
  gltf.square();
  add_normal_map(gltf, {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"scale", {-1, 1}}}}}}});
  EXPECT_EQ(mesh_of(opened(gltf))->tangents, std::vector<Vec4>(4, Vec4(-1, 0, 0, -1)));
}

TEST_F(NormalMaps, WithoutNormalsVerticesAreSplit) {
  Gltf gltf;
  gltf.square()["attributes"].erase("NORMAL");
  add_normal_map(gltf);
  const auto mesh = mesh_of(opened(gltf));
  EXPECT_EQ(mesh->positions.size(), 6U);
  EXPECT_EQ(mesh->normals, std::vector<Vec3>(6, Vec3(0, 0, 1)));
  EXPECT_EQ(mesh->tangents, std::vector<Vec4>(6, Vec4(1, 0, 0, 1)));
}

TEST_F(NormalMaps, MissingTextureCoordinatesAreReported) {
  Gltf gltf;
  gltf.square();
  add_normal_map(gltf, {{"index", 0}, {"texCoord", 1}});
  const auto scene = opened(gltf);
  EXPECT_TRUE(mesh_of(scene)->tangents.empty());
  EXPECT_TRUE(warns(
      scene, "meshes[0].primitives[0]: has no TEXCOORD_1, which the normal map or anisotropy of its material needs"));
}

}  // namespace
}  // namespace etendue::test
