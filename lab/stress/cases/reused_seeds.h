// The average of two images with different seeds, and with the same seed.   [Owen 2013, ch. 2]
#pragma once
#include "stress/case.h"
#include "stress/statistics.h"

namespace etendue::stress {

inline void reused_seeds(TestContext& test) {
  auto d = test.document(scene::furnace(0.5f), look_at({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 1));
  d.width = d.height = 128;
  d.filter = film::FilterKind::box;
  for (const char* sampler : {"random", "sobol"}) {
    const std::string method = std::string("path-pure:roulette-start=1:sampler=") + sampler;
    d = TestContext::with_method(d, method);
    const film::Film a = test.render(d, 4);
    auto other = d;
    other.seed = d.seed + 1;
    const film::Film b = test.render(other, 4);
    const double single = variance_of_mean(a, a);
    // A quarter of the sum of both variances, if they are uncorrelated. Variances over 16,000 pixels are known to 3 %.
    test.expect_near(method, "variance of two seeds' mean over that of one", variance_of_mean(a, b) / single, 0.5,
                     0.05);
    test.expect_near(method, "variance of one seed's mean with itself", variance_of_mean(a, test.render(d, 4)) / single,
                     1, 1e-9);
  }
}

inline constexpr Case kReusedSeeds{
    .name = "reused-seeds",
    .kind = Kind::correlation,
    .theory =
        "Averaging two images halves the variance if their seeds differ; with the same seed they are "
        "identical and nothing is gained",
    .run = reused_seeds};

}  // namespace etendue::stress
