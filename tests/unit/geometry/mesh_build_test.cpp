// Generation of tangents and repair of meshes.
#include "geometry/mesh_build.h"

#include <gtest/gtest.h>

#include <random>

#include "geometry/tangents.h"

namespace etendue {
namespace {

// A grid over the unit square in the xy plane; `uv` maps positions to texture coordinates.
template <class Uv>
Mesh grid(int n, Uv&& uv) {
  Mesh mesh;
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x) {
      const Vec3 p(static_cast<float>(x) / static_cast<float>(n), static_cast<float>(y) / static_cast<float>(n), 0);
      mesh.positions.push_back(p);
      mesh.normals.emplace_back(0, 0, 1);
      mesh.uvs[0].push_back(uv(p));
    }
  const auto row = static_cast<uint32_t>(n + 1);
  for (uint32_t y = 0; y + 1 < row; ++y)
    for (uint32_t x = 0; x + 1 < row; ++x) {
      const uint32_t i = y * row + x;
      mesh.triangles.push_back({i, i + 1, i + row});
      mesh.triangles.push_back({i + 1, i + row + 1, i + row});
    }
  return mesh;
}

TEST(Tangents, PointAlongU) {
  Mesh mesh = grid(4, [](const Vec3& p) { return Vec2(p.y, p.x); });
  EXPECT_TRUE(generate_tangents(mesh, 0).empty());
  for (const Vec4& t : mesh.tangents)
    EXPECT_EQ(t, Vec4(0, 1, 0, 1)) << "v increases along x, so the bitangent is -x = cross(z, y)";
}

TEST(Tangents, SplitVerticesWhereTheTextureIsMirrored) {
  // u decreases up to the middle and increases again; the vertices of the middle column belong to both sides.
  Mesh mesh = grid(4, [](const Vec3& p) { return Vec2(std::abs(p.x - 0.5f), -p.y); });
  const size_t before = mesh.positions.size();
  const auto copies = generate_tangents(mesh, 0);
  EXPECT_EQ(copies.size(), 5U);
  ASSERT_EQ(mesh.positions.size(), before + 5);
  ASSERT_EQ(mesh.tangents.size(), before + 5);
  for (size_t i = 0; i < copies.size(); ++i) EXPECT_EQ(mesh.positions[before + i], mesh.positions[copies[i]]);
  for (const Triangle& t : mesh.triangles) {
    const float x = (mesh.positions[t[0]].x + mesh.positions[t[1]].x + mesh.positions[t[2]].x) / 3;
    for (const uint32_t v : t) EXPECT_EQ(mesh.tangents[v], x > 0.5f ? Vec4(1, 0, 0, 1) : Vec4(-1, 0, 0, -1));
  }
}

TEST(Tangents, DoNotDependOnVertexSharing) {
  // The same grid without shared vertices.
  Mesh shared = grid(3, [](const Vec3& p) { return Vec2(p.x + 0.3f * p.y * p.y, p.y - 0.2f * p.x * p.y); });
  Mesh apart = shared;
  const auto sources = split_into_flat_triangles(apart);
  generate_tangents(shared, 0);
  generate_tangents(apart, 0);
  for (size_t i = 0; i < sources.size(); ++i)
    EXPECT_LT(glm::distance(apart.tangents[i], shared.tangents[sources[i]]), 1e-5f);
}

TEST(Tangents, AreUnitAndPerpendicularToNormals) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<float> number(-1, 1);
  Mesh mesh;
  for (int i = 0; i < 300; ++i) {
    mesh.positions.emplace_back(number(engine), number(engine), number(engine));
    mesh.normals.push_back(glm::normalize(Vec3(number(engine), number(engine), number(engine)) + Vec3(1e-3f)));
    // Some triangles have no texture area.
    mesh.uvs[0].push_back(i % 3 ? Vec2(number(engine), number(engine)) : Vec2(0.5f));
  }
  for (int i = 0; i < 400; ++i)
    mesh.triangles.push_back({uint32_t(engine() % 300), uint32_t(engine() % 300), uint32_t(engine() % 300)});
  drop_degenerate(mesh);
  generate_tangents(mesh, 0);
  for (const Triangle& t : mesh.triangles)
    for (const uint32_t v : t) {
      EXPECT_NEAR(glm::length(Vec3(mesh.tangents[v])), 1, 1e-4f);
      EXPECT_NEAR(glm::dot(Vec3(mesh.tangents[v]), mesh.normals[v]), 0, 1e-3f);
      EXPECT_EQ(std::abs(mesh.tangents[v].w), 1);
    }
}

TEST(MeshBuild, RemovesDuplicates) {
  Mesh mesh = grid(200, [](const Vec3& p) { return Vec2(p); });
  const auto original = mesh.triangles;
  EXPECT_EQ(drop_duplicates(mesh), 0U);
  std::mt19937 engine(3);
  for (int i = 0; i < 1000; ++i) {
    const Triangle t = original[engine() % original.size()];
    mesh.triangles.push_back({t[1], t[2], t[0]});
  }
  EXPECT_EQ(drop_duplicates(mesh), 1000U);
  EXPECT_EQ(mesh.triangles, original);
}

TEST(MeshBuild, TreatsSignedZerosAsEqual) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0f, 0, -0.0f}};
  mesh.triangles = {{0, 1, 2}, {3, 1, 2}};
  EXPECT_EQ(drop_duplicates(mesh), 1U);
}

TEST(MeshBuild, RemovesSlivers) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0.5f, 1e-5f, 0}, {0.5f, 1e-9f, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 1, 3}};
  EXPECT_EQ(drop_degenerate(mesh), 1U);
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}));
}

}  // namespace
}  // namespace etendue
