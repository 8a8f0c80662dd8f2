// Rays in packets meet what they meet alone.
#include <gtest/gtest.h>

#include <random>

#include "geometry/accel.h"
#include "support/scenes.h"

namespace etendue {
namespace {

constexpr int kSize = RayPacket::kSize;

class Packets : public testing::Test {
 protected:
  Packets() {
    const auto in_place = test::sphere(1, 24, false), instanced = test::cube(0.4f, false);
    Mat4 to_world(1);
    to_world[3] = Vec4(1.2f, 0.3f, 0, 1);
    const AccelInstance instances[] = {{in_place, nullptr, Mat4(1)},
                                       {instanced, std::make_shared<MeshAccel>(instanced), to_world}};
    accel_ = std::make_unique<Accel>(instances);
  }

  // From a shell around the scene towards it, so that some hit and some pass.
  Ray random_ray() {
    std::normal_distribution<float> normal;
    const auto direction = [&] { return glm::normalize(Vec3(normal(engine_), normal(engine_), normal(engine_))); };
    Ray ray;
    ray.origin = 4.0f * direction();
    ray.direction = glm::normalize(1.5f * direction() - ray.origin);
    return ray;
  }

  std::unique_ptr<Accel> accel_;
  std::mt19937 engine_{11};
  const std::array<uint32_t, kSize> seeds_{};
};

TEST_F(Packets, FindTheHitsOfSingleRays) {
  int met = 0;
  for (int count = 1; count <= kSize; ++count) {
    RayPacket packet;
    std::array<Ray, kSize> rays;
    for (int i = 0; i < count; ++i) packet.set(i, rays[static_cast<size_t>(i)] = random_ray());
    accel_->intersect(packet, count, false, nullptr, seeds_.data());
    for (int i = 0; i < count; ++i) {
      Hit alone, together;
      accel_->intersect(rays[static_cast<size_t>(i)], nullptr, 0, alone);
      ASSERT_EQ(packet.has_hit(i), static_cast<bool>(alone));
      if (!alone) continue;
      ++met;
      packet.get(i, together);
      EXPECT_EQ(together.instance, alone.instance);
      EXPECT_NEAR(together.t, alone.t, 1e-5f);
    }
  }
  EXPECT_GT(met, 20);
}

TEST_F(Packets, AreBlockedWhereSingleRaysAre) {
  int blocked = 0, open = 0;
  for (int count = 1; count <= kSize; ++count) {
    RayPacket packet;
    std::array<Ray, kSize> rays;
    for (int i = 0; i < count; ++i) {
      Ray& ray = rays[static_cast<size_t>(i)];
      ray = random_ray();
      ray.tfar = i % 2 ? kInfinity : 3.0f;  // the shorter end before most of the scene
      packet.set(i, ray);
    }
    accel_->occluded(packet, count, nullptr, seeds_.data());
    for (int i = 0; i < count; ++i) {
      Hit alone;
      accel_->intersect(rays[static_cast<size_t>(i)], nullptr, 0, alone);
      EXPECT_EQ(packet.is_occluded(i), static_cast<bool>(alone));
      ++(packet.is_occluded(i) ? blocked : open);
    }
  }
  EXPECT_GT(blocked, 20);
  EXPECT_GT(open, 20);
}

TEST_F(Packets, CanBeUsedAgain) {
  RayPacket packet;
  Ray towards, away;
  towards.origin = away.origin = Vec3(0, 0, 4);
  towards.direction = Vec3(0, 0, -1), away.direction = Vec3(0, 0, 1);
  packet.set(0, towards);
  accel_->intersect(packet, 1, true, nullptr, seeds_.data());
  EXPECT_TRUE(packet.has_hit(0));
  packet.set(0, away);
  accel_->intersect(packet, 1, true, nullptr, seeds_.data());
  EXPECT_FALSE(packet.has_hit(0)) << "the hit of the ray before must not stay";
}

}  // namespace
}  // namespace etendue
