// The noise of a picture against that of another seed, and against itself one pixel further.
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void seeds_and_pixels(Lab& lab) {
  auto d = lab.document(scene::furnace(0.5f), look_at({0, 0, 0}, {0, 0, 1}, {0, 1, 0}, 1));
  d.width = d.height = 128;
  for (const char* sampler : {"random", "stratified", "halton", "sobol"}) {
    const std::string method = std::string("path-pure:roulette-start=1:sampler=") + sampler;
    d = Lab::with_method(d, method);
    d.filter = film::FilterKind::box;
    const film::Film a = lab.render(d, 2);
    auto other = d;
    other.seed = d.seed + 1;
    const film::Film b = lab.render(other, 2);
    const double n = static_cast<double>(d.width) * d.height;
    const double margin = Lab::kSigmas / std::sqrt(n);
    lab.expect_between(method, "between seeds", noise_correlation(a, b, 0), -margin, margin);
    lab.expect_between(method, "between neighbours", noise_correlation(a, a, 1), -margin, margin);
  }
}

inline constexpr Case kSeedsAndPixels{"seeds-and-pixels", Kind::correlation,
                                      "Noise of two seeds, and of neighbouring pixels, is independent: correlations "
                                      "stay within 4.5 standard errors of zero",
                                      seeds_and_pixels};

}  // namespace etendue::stress
