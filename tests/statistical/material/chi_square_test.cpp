// The chi-square test itself: it distinguishes slightly wrong densities from correct ones, also for narrow lobes.
#include "support/chi_square.h"

#include <gtest/gtest.h>

#include "base/frame.h"
#include "bsdf/microfacet/cosine_exponent.h"
#include "support/model_cases.h"

namespace etendue {
namespace {

using test::direction;
using test::Random;

// Directions distributed as cos^n about an axis, tested against the density of cos^m times a factor.
double p_value(float n, float m, double factor, unsigned seed) {
  const Frame frame(direction(50));
  Random random(seed);
  return test::chi_square_on_sphere(
             [&](Vec3& w) {
               w = frame.to_world(square_to_cosine_power(random.uniform2(), n));
               return true;
             },
             [&](const Vec3& w) {
               const Vec3 local = frame.to_local(w);
               const double sin2 = double{local.x} * local.x + double{local.y} * local.y;
               if (!(local.z > 0) || sin2 >= 1) return 0.0;
               return factor * (m + 1) / (2 * M_PI) * std::exp(0.5 * m * std::log1p(-sin2));
             },
             20'000)
      .p_value;
}

TEST(ChiSquare, RejectsWrongDensitiesAndAcceptsCorrectOnes) {
  unsigned seed = 3;
  for (const float n : {1.0f, 30.0f, 1e3f, 1e5f}) {
    EXPECT_GT(p_value(n, n, 1, ++seed), 0.01 / 4) << n;
    EXPECT_LT(p_value(n, 1.3f * n, 1, ++seed), 1e-6) << n;
    EXPECT_LT(p_value(n, n, 0.95, ++seed), 1e-6) << n;
  }
}

// A part of the sphere where the density is positive and no direction is sampled.
TEST(ChiSquare, DetectsDirectionsThatAreNeverSampled) {
  Random random(5);
  const auto result = test::chi_square_on_sphere(
      [&](Vec3& w) {
        w = random.upper_direction();
        return true;
      },
      [](const Vec3& w) { return w.z > 0 ? w.z * kInvPi : 0.02f * kInvPi; }, 20'000);
  EXPECT_LT(result.p_value, 1e-6);
}

}  // namespace
}  // namespace etendue
