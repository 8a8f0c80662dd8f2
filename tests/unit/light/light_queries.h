// Random numbers, receivers and light tables for tests of lights.
#pragma once
#include <random>
#include <vector>

#include "base/warp.h"
#include "light/placed_light.h"
#include "light/sampling/light_table.h"

namespace etendue::test {

class RandomNumbers {
 public:
  explicit RandomNumbers(uint32_t seed) : engine_(seed) {}
  float operator()() { return std::min(uniform_(engine_), kOneMinusEpsilon); }
  Vec2 pair() {
    const float x = (*this)();
    return {x, (*this)()};
  }
  Vec3 in_cube(float half) {
    const Vec2 xy = pair();
    return half * (2.0f * Vec3(xy, (*this)()) - 1.0f);
  }
  Vec3 direction() { return square_to_sphere(pair()); }

 private:
  std::mt19937 engine_;
  std::uniform_real_distribution<float> uniform_{0, 1};
};

// Receivers with the random numbers of their samples: more than one batch, and not a multiple of the register width.
struct Receivers {
  static constexpr size_t kCount = 1000;
  static constexpr size_t kCapacity = 1008;

  Vec3Lanes<kCapacity> from;
  alignas(64) std::array<float, kCapacity> choice{}, u0{}, u1{}, times{};

  // All receivers at one position.
  void draw(RandomNumbers& random, const Vec3& position) { draw(random, position, 0); }
  // Receivers in a cube around a centre.
  void draw(RandomNumbers& random, const Vec3& centre, float half_size) {
    for (size_t i = 0; i < kCapacity; ++i) {
      from.set(i, centre + random.in_cube(half_size));
      choice[i] = random();
      u0[i] = random();
      u1[i] = random();
      times[i] = static_cast<float>(i) / kCapacity;
    }
  }
  LightQueries queries() { return {from, choice.data(), u0.data(), u1.data(), kCount}; }
  std::vector<LightSample> sample(const LightTable& table, LightStrategy strategy = LightStrategy::one) {
    std::vector<LightSample> samples(kCount);
    table.sample(queries(), samples.data(), strategy);
    return samples;
  }
};

inline AreaLightTriangle triangle(const Vec3& p0, const Vec3& p1, const Vec3& p2, float radiance, bool double_sided) {
  AreaLightTriangle t;
  t.radiance = Rgb(radiance);
  t.double_sided = double_sided;
  t.set_triangle({p0, p1, p2, 1});
  return t;
}

inline PlacedLight placed(const LightEmitter& emitter, const Vec3& position, const Vec3& direction = {0, 0, -1}) {
  PlacedLight light{.emitter = emitter, .place = {}, .motion = nullptr, .name = {}, .type = nullptr};
  light.place.position = position;
  light.place.direction = direction;
  return light;
}

inline Bounds bounds(const Vec3& low, const Vec3& high) {
  Bounds b;
  b.extend(low);
  b.extend(high);
  return b;
}

inline Environment constant_environment(float radiance) {
  Environment environment;
  environment.tint = Rgb(radiance);
  return environment;
}

}  // namespace etendue::test
