// Two pictures averaged: of two seeds, and of one seed twice.
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void reused_seeds(Lab& lab) {
  auto d = lab.document(scene::furnace(0.5f), look_at({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 1));
  d.width = d.height = 128;
  d.filter = film::FilterKind::box;
  for (const char* sampler : {"random", "sobol"}) {
    const std::string method = std::string("path-pure:roulette-start=1:sampler=") + sampler;
    d = Lab::with_method(d, method);
    const film::Film a = lab.render(d, 4);
    auto other = d;
    other.seed = d.seed + 1;
    const film::Film b = lab.render(other, 4);
    const double alone = variance_of_mean(a, a);
    // A quarter of the variances' sum, if the covariance is nothing; variances over 16,000 pixels are good to 3 %.
    lab.expect_near(method, "variance of two seeds' mean over that of one", variance_of_mean(a, b) / alone, 0.5, 0.05);
    lab.expect_near(method, "variance of one seed's mean with itself", variance_of_mean(a, lab.render(d, 4)) / alone, 1,
                    1e-9);
  }
}

inline constexpr Case kReusedSeeds{"reused-seeds", Kind::correlation,
                                   "Averaging two pictures halves the variance if their seeds differ; with the same "
                                   "seed they are the same picture, and nothing is won",
                                   reused_seeds};

}  // namespace etendue::stress
