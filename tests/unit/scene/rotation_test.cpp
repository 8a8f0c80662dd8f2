// Conversions between Euler angles, quaternions and matrices.
#include "scene/rotation.h"

#include <gtest/gtest.h>

namespace etendue {
namespace {

using scene::Transform;

void expect_same(const Mat4& a, const Mat4& b, float tolerance) {
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r) EXPECT_NEAR(a[c][r], b[c][r], tolerance) << c << ' ' << r;
}

Mat4 turned(const Vec3& degrees) { return Transform{.rotation = scene::rotation_of(degrees)}.to_matrix(); }

TEST(Rotation, AnglesRoundTrip) {
  for (float x = -175; x < 180; x += 35)
    for (float y = -85; y < 90; y += 17)
      for (float z = -170; z < 180; z += 34) {
        const Vec3 back = scene::euler_degrees(scene::rotation_of(Vec3(x, y, z)));
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(back[c], Vec3(x, y, z)[c], 2e-3f) << x << ' ' << y << ' ' << z;
      }
  EXPECT_EQ(scene::euler_degrees(scene::rotation_of(Vec3(30, -45, 90))), Vec3(30, -45, 90));
  EXPECT_EQ(scene::euler_degrees(Vec4(0, 0, 0, 1)), Vec3(0));
  EXPECT_EQ(scene::euler_degrees(Vec4(0)), Vec3(0));
}

TEST(Rotation, AnglesOutOfRangeGiveTheSameRotation) {
  for (const Vec3& degrees :
       {Vec3(10, 90, 0), Vec3(25, -90, 40), Vec3(0, 120, 0), Vec3(300, 200, -250), Vec3(0, 90, 90)})
    expect_same(turned(scene::euler_degrees(scene::rotation_of(degrees))), turned(degrees), 2e-5f);
}

TEST(Rotation, XIsAppliedFirst) {
  // 90 degrees about x map y to z; 90 degrees about z leave it there.
  const Vec4 y = turned(Vec3(90, 0, 90)) * Vec4(0, 1, 0, 0);
  EXPECT_NEAR(y.z, 1, 1e-6f);
  EXPECT_NEAR(y.x, 0, 1e-6f);
}

TEST(Rotation, QuaternionsAreNormalisedWhenUsed) {
  expect_same(Transform{.rotation = Vec4(0, 2, 0, 2)}.to_matrix(), turned(Vec3(0, 90, 0)), 1e-6f);
  expect_same(Transform{.rotation = Vec4(0)}.to_matrix(), Mat4(1), 0);
}

TEST(Rotation, MatricesAreDecomposed) {
  for (const Vec3& scale : {Vec3(1), Vec3(0.01f, 3, 200), Vec3(-1, 2, 1), Vec3(2, -2, 2), Vec3(-1, -1, -1)}) {
    Transform t{.translation = Vec3(4, 5, -6), .rotation = scene::rotation_of(Vec3(20, 30, 140)), .scale = scale};
    const Transform matrix{.matrix = t.to_matrix()};
    const auto parts = scene::decompose(matrix);
    ASSERT_TRUE(parts);
    EXPECT_FALSE(parts->matrix);
    expect_same(parts->to_matrix(), *matrix.matrix, 1e-4f);
    EXPECT_EQ(*scene::decompose(*parts), *parts);
  }
}

TEST(Rotation, ShearedAndSingularMatricesAreNotDecomposed) {
  Mat4 sheared(1), flat(1);
  sheared[1][0] = 0.5f;
  flat[2] = Vec4(0);
  EXPECT_FALSE(scene::decompose({.matrix = sheared}));
  EXPECT_FALSE(scene::decompose({.matrix = flat}));
}

}  // namespace
}  // namespace etendue
