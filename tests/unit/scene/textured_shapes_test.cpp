// Shapes with texture coordinates: areas, orientation, and the place of the texture.
#include "scene/builtin/textured_shapes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace etendue::scene {
namespace {

struct Areas {
  double surface = 0, texture = 0;
  int mirrored = 0, inwards = 0;
};

Areas areas_of(const Mesh& mesh) {
  Areas areas;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.positions[t[0]], b = mesh.positions[t[1]], c = mesh.positions[t[2]];
    const Vec2 p = mesh.uvs[0][t[0]], q = mesh.uvs[0][t[1]], r = mesh.uvs[0][t[2]];
    const Vec3 normal = glm::cross(b - a, c - a);
    areas.surface += 0.5 * double{glm::length(normal)};
    // Positive for a texture that is not mirrored, because v increases downwards.
    const double signed_area = 0.5 * double{(r.x - p.x) * (q.y - p.y) - (q.x - p.x) * (r.y - p.y)};
    areas.texture += signed_area;
    areas.mirrored += signed_area <= 0;
    areas.inwards += glm::dot(normal, a + b + c) < 0;
  }
  return areas;
}

TEST(TexturedShapes, CoverTheTextureOnceWithoutMirroring) {
  constexpr double kPiD = 3.14159265358979;
  struct Case {
    const char* name;
    double surface, texture, tolerance;
  };
  // The sphere lacks half of the texture of the rows at the poles; its polygons have a smaller area.
  for (const Case& c : {Case{"plane", 4, 1, 1e-6}, Case{"box", 24, 6, 1e-6}, Case{"disk", kPiD, kPiD / 4, 1e-5},
                        Case{"sphere", 4 * kPiD * 0.999, 1 - 1.0 / 48, 1e-3}}) {
    const auto mesh = textured_shape(c.name);
    ASSERT_TRUE(mesh) << c.name;
    ASSERT_EQ(mesh->uvs[0].size(), mesh->positions.size()) << c.name;
    EXPECT_GT(mesh->positions.capacity(), mesh->positions.size()) << c.name;
    const Areas areas = areas_of(*mesh);
    EXPECT_NEAR(areas.surface, c.surface, c.surface * c.tolerance) << c.name;
    EXPECT_NEAR(areas.texture, c.texture, c.texture * 1e-4) << c.name;
    EXPECT_EQ(areas.mirrored, 0) << c.name;
    EXPECT_EQ(areas.inwards, 0) << c.name;
  }
  EXPECT_FALSE(textured_shape("cone"));
}

// The texture is upright: v is 0 at the top of walls and at the far side of floors seen from +z.
TEST(TexturedShapes, TexturesAreUpright) {
  for (const char* name : {"sphere", "box"}) {
    const auto mesh = textured_shape(name);
    for (const Triangle& t : mesh->triangles)
      for (size_t i = 0; i < 3; ++i) {
        const Vec3 a = mesh->positions[t[i]], b = mesh->positions[t[(i + 1) % 3]];
        const Vec2 p = mesh->uvs[0][t[i]], q = mesh->uvs[0][t[(i + 1) % 3]];
        if (std::abs(a.y - b.y) < 1e-4f) continue;
        EXPECT_LT((q.y - p.y) * (b.y - a.y), 0) << name;
      }
  }
  for (const char* name : {"plane", "disk"}) {
    const auto mesh = textured_shape(name);
    for (size_t i = 0; i < mesh->positions.size(); ++i) {
      EXPECT_NEAR(mesh->uvs[0][i].x, 0.5f + 0.5f * mesh->positions[i].x, 1e-6f) << name;
      EXPECT_NEAR(mesh->uvs[0][i].y, 0.5f + 0.5f * mesh->positions[i].z, 1e-6f) << name;
    }
  }
}

// No triangle of the sphere spans the seam, and neighbours there meet.
TEST(TexturedShapes, TheSphereHasASeam) {
  const auto mesh = textured_shape("sphere");
  for (const Triangle& t : mesh->triangles)
    for (size_t i = 0; i < 3; ++i)
      EXPECT_LT(std::abs(mesh->uvs[0][t[i]].x - mesh->uvs[0][t[(i + 1) % 3]].x), 0.02f);
  for (size_t i = 0; i < mesh->positions.size(); ++i) {
    EXPECT_NEAR(glm::length(mesh->positions[i]), 1, 1e-6f);
    EXPECT_NEAR(glm::dot(mesh->positions[i], mesh->normals[i]), 1, 1e-6f);
  }
  constexpr size_t kRow = 97;
  for (size_t row = 1; row < 48; ++row)
    EXPECT_EQ(mesh->positions[row * kRow], mesh->positions[row * kRow + kRow - 1]) << row;
}

}  // namespace
}  // namespace etendue::scene
