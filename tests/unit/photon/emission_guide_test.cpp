// Photons towards specular objects: the expected flux in every direction is that of the light.
#include "integrator/shared/emission_guide.h"

#include <gtest/gtest.h>

#include <random>

namespace etendue {
namespace {

using integrator::EmissionGuide;

// Means of the weight times 1, y and x^2 of the direction, and the share of directions in a cone.
struct Moments {
  double all = 0, y = 0, xx = 0, in_cone = 0;
};

class Photons {
 public:
  explicit Photons(const EmissionGuide& guide) : guide_(guide) {}

  // From a diffuse surface of unit radiance and area with the normal +y.
  Moments from_surface(const Vec3& axis, float cos_cone) {
    return moments(axis, cos_cone, [&] {
      Emission e;
      const Vec3 local = square_to_cosine_hemisphere({uniform(), uniform()});
      e.direction = {local.x, local.z, local.y};
      e.density.first = 1;
      e.density.second = e.direction.y / kPi;
      e.weight = e.direction.y / e.density.second;
      const Vec3 normal(0, 1, 0);
      guide_.redirect(&normal, uniform(), {uniform(), uniform()}, e);
      return e;
    });
  }
  // From a point light of unit intensity.
  Moments from_point(const Vec3& axis, float cos_cone) {
    return moments(axis, cos_cone, [&] {
      Emission e;
      e.kind = LightKind::placed;
      e.direction = square_to_sphere({uniform(), uniform()});
      e.density.first = 1;
      e.density.second = 1 / (4 * kPi);
      e.weight = 1 / e.density.second;
      guide_.redirect(nullptr, uniform(), {uniform(), uniform()}, e);
      return e;
    });
  }

 private:
  static constexpr int kCount = 400'000;

  float uniform() { return std::min(distribution_(engine_), kOneMinusEpsilon); }

  template <class Make>
  static Moments moments(const Vec3& axis, float cos_cone, Make&& make) {
    Moments m;
    for (int i = 0; i < kCount; ++i) {
      const Emission e = make();
      const double w = double{e.weight} / kCount;
      m.all += w;
      m.y += w * double{e.direction.y};
      m.xx += w * double{sqr(e.direction.x)};
      m.in_cone += glm::dot(e.direction, axis) > cos_cone ? 1.0 / kCount : 0;
    }
    return m;
  }

  const EmissionGuide& guide_;
  std::mt19937 engine_{7};
  std::uniform_real_distribution<float> distribution_{0, 1};
};

// Standard errors are below 0.4 % of each mean; the tolerance is five of them. A sphere of radius 0.5 at a distance of 3
// subtends an angle of asin(1/6).
TEST(EmissionGuide, KeepsTheExpectedFlux) {
  const std::vector<EmissionGuide::Sphere> spheres{{{0, 3, 0}, 0.5f}, {{2, 2, 0}, 0.4f}, {{0, 3.2f, 0.1f}, 0.5f}};
  for (const float share : {0.3f, 0.9f}) {
    const EmissionGuide guide(spheres, share);
    Photons photons(guide);
    const Vec3 axis(0, 1, 0);
    const float cos_cone = std::sqrt(35.0f) / 6;
    const Moments surface = photons.from_surface(axis, cos_cone);
    const double pi = 3.14159265358979;
    const double tolerance = share > 0.5f ? 0.03 : 0.01;
    EXPECT_NEAR(surface.all / pi, 1, tolerance);
    EXPECT_NEAR(surface.y / (2 * pi / 3), 1, tolerance);
    EXPECT_NEAR(surface.xx / (pi / 4), 1, 2 * tolerance);
    EXPECT_GT(surface.in_cone, 0.4 * double{share});
    const Moments point = photons.from_point(axis, cos_cone);
    EXPECT_NEAR(point.all / (4 * pi), 1, tolerance);
    EXPECT_NEAR(point.xx / (4 * pi / 3), 1, 2 * tolerance);
    EXPECT_GT(point.in_cone, 0.4 * double{share});
  }
}

// Inside a sphere and under wide objects, directions are left to the light.
TEST(EmissionGuide, LeavesWideObjectsToTheLight) {
  for (const EmissionGuide::Sphere& sphere :
       {EmissionGuide::Sphere{{0, 0.2f, 0}, 1}, EmissionGuide::Sphere{{0, 1, 0}, 0.99f}}) {
    const EmissionGuide guide({sphere}, 0.9f);
    Emission e;
    e.direction = {0.6f, 0.8f, 0};
    e.density.first = 1;
    e.density.second = 0.8f / kPi;
    e.weight = kPi;
    const Vec3 normal(0, 1, 0);
    guide.redirect(&normal, 0.1f, {0.5f, 0.5f}, e);
    EXPECT_EQ(e.direction, Vec3(0.6f, 0.8f, 0));
    EXPECT_EQ(e.weight, kPi);
  }
}

}  // namespace
}  // namespace etendue
