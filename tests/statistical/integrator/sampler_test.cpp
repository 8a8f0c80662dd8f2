// Samplers: low-discrepancy points converge to the same image faster.
#include <gtest/gtest.h>

#include "support/scenes.h"

namespace etendue {
namespace {

// Scrambled Sobol' points give the same pixels with less noise.
TEST(Samplers, SobolHasLessErrorThanRandomOnCornell) {
  auto d = test::cornell(32);
  d.seed = 99;
  const auto reference = test::rendered(d, 4096);
  d.seed = 1;
  const auto mse = [&](const char* sampler) {
    d.method.sampler = sampler;
    const auto film = test::rendered(d, 64);
    double sum = 0;
    for (int y = 0; y < d.height; ++y)
      for (int x = 0; x < d.width; ++x)
        for (int c = 0; c < 3; ++c) sum += sqr(double{film.mean(x, y)[c]} - reference.mean(x, y)[c]);
    return sum;
  };
  EXPECT_GT(mse("random"), 2 * mse("sobol"));
}

}  // namespace
}  // namespace etendue
