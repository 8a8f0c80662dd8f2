// Packets of rays have the hits of single rays.
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

  // A ray from a sphere around the scene towards it; some hit, some miss.
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

TEST_F(Packets, HaveTheHitsOfSingleRays) {
  int hits = 0;
  for (int count = 1; count <= kSize; ++count) {
    RayPacket packet;
    std::array<Ray, kSize> rays;
    for (int i = 0; i < count; ++i) {
      rays[static_cast<size_t>(i)] = random_ray();
      packet.set(i, rays[static_cast<size_t>(i)]);
    }
    accel_->intersect(packet, count, false, nullptr, seeds_.data());
    for (int i = 0; i < count; ++i) {
      Hit single, in_packet;
      accel_->intersect(rays[static_cast<size_t>(i)], nullptr, 0, single);
      ASSERT_EQ(packet.has_hit(i), static_cast<bool>(single));
      if (!single) continue;
      ++hits;
      packet.get(i, in_packet);
      EXPECT_EQ(in_packet.instance, single.instance);
      EXPECT_NEAR(in_packet.t, single.t, 1e-5f);
    }
  }
  EXPECT_GT(hits, 20);
}

TEST_F(Packets, AreOccludedLikeSingleRays) {
  int occluded = 0, visible = 0;
  for (int count = 1; count <= kSize; ++count) {
    RayPacket packet;
    std::array<Ray, kSize> rays;
    for (int i = 0; i < count; ++i) {
      Ray& ray = rays[static_cast<size_t>(i)];
      ray = random_ray();
      ray.tfar = i % 2 ? kInfinity : 3.0f;  // short rays end before most of the scene
      packet.set(i, ray);
    }
    accel_->occluded(packet, count, nullptr, seeds_.data());
    for (int i = 0; i < count; ++i) {
      Hit single;
      accel_->intersect(rays[static_cast<size_t>(i)], nullptr, 0, single);
      EXPECT_EQ(packet.is_occluded(i), static_cast<bool>(single));
      ++(packet.is_occluded(i) ? occluded : visible);
    }
  }
  EXPECT_GT(occluded, 20);
  EXPECT_GT(visible, 20);
}

TEST_F(Packets, CanBeReused) {
  RayPacket packet;
  Ray towards, away;
  towards.origin = Vec3(0, 0, 4);
  towards.direction = Vec3(0, 0, -1);
  away.origin = Vec3(0, 0, 4);
  away.direction = Vec3(0, 0, 1);
  packet.set(0, towards);
  accel_->intersect(packet, 1, true, nullptr, seeds_.data());
  EXPECT_TRUE(packet.has_hit(0));
  packet.set(0, away);
  accel_->intersect(packet, 1, true, nullptr, seeds_.data());
  EXPECT_FALSE(packet.has_hit(0)) << "the hit of the previous ray must be cleared";
}

}  // namespace
}  // namespace etendue
