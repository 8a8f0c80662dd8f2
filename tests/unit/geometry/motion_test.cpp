// Moving meshes: interpolation, and rays hit them at their position at the time of the ray.
#include "geometry/motion.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "geometry/accel.h"
#include "support/scenes.h"

namespace etendue {
namespace {

constexpr int kSize = RayPacket::kSize;

std::shared_ptr<Motion> turning() {
  auto motion = std::make_shared<Motion>();
  for (const float angle : {0.0f, 0.5f, 1.0f, 1.5f})
    motion->to_world.push_back(glm::rotate(glm::translate(Mat4(1), {angle, 0, 0}), angle, Vec3(0, 0, 1)));
  return motion;
}

std::shared_ptr<Motion> growing(const Mesh& mesh) {
  auto motion = std::make_shared<Motion>();
  for (const float size : {1.0f, 1.5f, 1.2f}) {
    DeformedVertices& v = motion->vertices.emplace_back();
    v.positions.reserve(mesh.positions.size() + 1);
    for (const Vec3& p : mesh.positions) {
      v.positions.push_back(size * p);
      v.normals.push_back(size * p);
    }
  }
  return motion;
}

TEST(Motion, InterpolatesPosesLinearly) {
  const auto motion = turning();
  EXPECT_EQ(motion->steps(), 4U);
  EXPECT_EQ(motion->matrix_at(0), motion->to_world[0]);
  EXPECT_EQ(motion->matrix_at(1), motion->to_world[3]);
  const Mat4 half = (motion->to_world[1] + motion->to_world[2]) * 0.5f;
  for (int c = 0; c < 4; ++c) EXPECT_LT(glm::distance(motion->matrix_at(0.5f)[c], half[c]), 1e-6f);
}

TEST(Motion, MirroringMatricesReverseTheWinding) {
  const auto mesh = test::cube(1, false);
  Motion motion;
  motion.to_world = {Mat4(1), glm::scale(Mat4(1), Vec3(-1, 1, 1))};
  EXPECT_EQ(motion.facet_at(*mesh, mesh->triangles[0], 0.2f).winding, 1);
  EXPECT_EQ(motion.facet_at(*mesh, mesh->triangles[0], 0.8f).winding, -1);
}

TEST(Motion, RotatesNormals) {
  auto mesh = *test::cube(1, false);
  mesh.normals.assign(mesh.positions.size(), Vec3(1, 0, 0));
  const Vec3 n = glm::normalize(turning()->normal_at(mesh, mesh.triangles[0], 0.2f, 0.3f, 2.0f / 3));
  EXPECT_LT(glm::distance(n, Vec3(std::cos(1.0f), std::sin(1.0f), 0)), 1e-5f);
}

TEST(Motion, RotatesTangents) {
  auto mesh = *test::cube(1, false);
  mesh.tangents.assign(mesh.positions.size(), Vec4(1, 0, 0, -1));
  const Vec4 t = turning()->tangent_at(mesh, mesh.triangles[0], 0.2f, 0.3f, 2.0f / 3);
  EXPECT_LT(glm::distance(t, Vec4(std::cos(1.0f), std::sin(1.0f), 0, -1)), 1e-5f);
}

TEST(Motion, InterpolatesNormalsAndTangentsOfDeformations) {
  const auto mesh = test::sphere(1, 8, false);
  const auto motion = growing(*mesh);
  for (auto& v : motion->vertices)
    for (const Vec3& n : v.normals) v.tangents.emplace_back(-n, 1);
  const Triangle& t = mesh->triangles[20];
  const auto& p = mesh->positions;
  const Vec3 at_first = p[t[0]] * 0.5f + p[t[1]] * 0.2f + p[t[2]] * 0.3f;
  for (const auto& [time, size] : {std::pair{0.0f, 1.0f}, {0.25f, 1.25f}, {0.5f, 1.5f}, {1.0f, 1.2f}}) {
    EXPECT_LT(glm::distance(motion->normal_at(*mesh, t, 0.2f, 0.3f, time), size * at_first), 1e-6f);
    EXPECT_LT(glm::distance(motion->tangent_at(*mesh, t, 0.2f, 0.3f, time), Vec4(-size * at_first, 1)), 1e-6f);
  }
}

class MovingMeshes : public testing::Test {
 protected:
  MovingMeshes() {
    const auto ball = test::sphere(1, 12, false), box = test::cube(0.4f, false);
    instances_ = {{ball, nullptr, Mat4(1), growing(*ball)},
                  {box, std::make_shared<MeshAccel>(box), Mat4(1), turning()},
                  {test::quad(3), nullptr, Mat4(1), nullptr}};
    accel_ = std::make_unique<Accel>(instances_);
  }

  // A ray from a sphere around the scene towards it.
  Ray random_ray() {
    std::normal_distribution<float> normal;
    const auto direction = [&] { return glm::normalize(Vec3(normal(engine_), normal(engine_), normal(engine_))); };
    Ray ray;
    ray.origin = 4.0f * direction();
    ray.direction = glm::normalize(1.5f * direction() - ray.origin);
    return ray;
  }

  Vec3 hit_position(const Hit& hit, float time) const {
    const AccelInstance& instance = instances_[hit.instance];
    const Triangle& t = instance.mesh->triangles[hit.triangle];
    const auto& p = instance.mesh->positions;
    const Facet f =
        instance.motion ? instance.motion->facet_at(*instance.mesh, t, time) : Facet{p[t[0]], p[t[1]], p[t[2]], 1};
    return f.p0 * (1 - hit.u - hit.v) + f.p1 * hit.u + f.p2 * hit.v;
  }

  std::vector<AccelInstance> instances_;
  std::unique_ptr<Accel> accel_;
  std::mt19937 engine_{5};
};

TEST_F(MovingMeshes, AreHitAtTheirPositions) {
  std::uniform_real_distribution<float> uniform;
  const std::array<uint32_t, kSize> seeds{};
  std::array<int, 3> hits{};
  for (int round = 0; round < 400; ++round) {
    RayPacket packet;
    std::array<Ray, kSize> rays;
    std::array<float, kSize> times;
    for (int i = 0; i < kSize; ++i) {
      const auto k = static_cast<size_t>(i);
      rays[k] = random_ray();
      times[k] = uniform(engine_);
      packet.set(i, rays[k]);
      packet.set_time(i, times[k]);
    }
    accel_->intersect(packet, kSize, false, nullptr, seeds.data());
    for (int i = 0; i < kSize; ++i) {
      const auto k = static_cast<size_t>(i);
      Hit single, in_packet;
      accel_->intersect(rays[k], nullptr, 0, single, times[k]);
      ASSERT_EQ(packet.has_hit(i), static_cast<bool>(single));
      if (!single) continue;
      packet.get(i, in_packet);
      EXPECT_NEAR(in_packet.t, single.t, 1e-4f);
      EXPECT_LT(glm::distance(hit_position(in_packet, times[k]), rays[k].origin + rays[k].direction * in_packet.t),
                1e-4f);
      ++hits[in_packet.instance];
    }
  }
  for (const int n : hits) EXPECT_GT(n, 50);
}

TEST_F(MovingMeshes, AreInsideTheBoundsAtAllTimes) {
  const Bounds bounds = accel_->bounds();
  for (const AccelInstance& instance : instances_)
    for (const float time : {0.0f, 0.3f, 0.6f, 1.0f})
      for (const Triangle& t : instance.mesh->triangles)
        if (instance.motion) {
          const Vec3 p = instance.motion->facet_at(*instance.mesh, t, time).p0;
          EXPECT_TRUE(glm::all(glm::lessThanEqual(bounds.min - 1e-4f, p)) &&
                      glm::all(glm::lessThanEqual(p, bounds.max + 1e-4f)));
        }
}

}  // namespace
}  // namespace etendue
