// Correlation of the noise of two seeds, and of neighbouring pixels of one image.   [Owen 2013, ch. 3]
#pragma once
#include "stress/case.h"
#include "stress/statistics.h"

namespace etendue::stress {

inline void seeds_and_pixels(TestContext& test) {
  auto d = test.document(scene::furnace(0.5f), look_at({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 1));
  d.width = d.height = 128;
  for (const char* sampler : {"random", "stratified", "halton", "sobol"}) {
    const std::string method = std::string("path-pure:roulette-start=1:sampler=") + sampler;
    d = TestContext::with_method(d, method);
    d.filter = film::FilterKind::box;
    const film::Film a = test.render(d, 2);
    auto other = d;
    other.seed = d.seed + 1;
    const film::Film b = test.render(other, 2);
    const double n = static_cast<double>(d.width) * d.height;
    const double margin = TestContext::kSigmas / std::sqrt(n);
    test.expect_between(method, "correlation of two seeds", noise_correlation(a, b, 0), -margin, margin);
    test.expect_between(method, "correlation of neighbouring pixels", noise_correlation(a, a, 1), -margin, margin);
  }
}

inline constexpr Case kSeedsAndPixels{
    .name = "seeds-and-pixels",
    .kind = Kind::correlation,
    .theory =
        "The noise of different seeds and of neighbouring pixels is independent: correlation "
        "coefficients lie within 4.5 standard errors of zero",
    .run = seeds_and_pixels};

}  // namespace etendue::stress
