// Roulette that ends walks faster than twice their throughput falls.
#pragma once
#include <cmath>

#include "stress/case.h"
#include "transport/wavefront/path_estimators.h"

namespace etendue::stress {

inline void roulette_below_the_square(Lab& lab) {
  for (const double albedo : {0.9, 0.99, 0.999}) {
    const auto furnace = scene::furnace(static_cast<float>(albedo));
    auto d = lab.document(furnace, look_at({0.2f, 0, 0}, {0, 0, 1}, {0, 1, 0}, 1));
    const std::string method = "path-pure:sampler=random:roulette-start=1";
    const double khat = lab.tail(Lab::with_method(d, method), 64).khat.value_or(-1);
    const std::string point = "khat at albedo " + number(albedo);
    // A walk of n edges has the probability q^n and the weight (r / q)^n.
    const double q = transport::kMaxSurvivalOfTheHeavy, theory = -std::log(albedo / q) / std::log(q);
    // The fit scatters by 0.06 at so many samples, and is drawn a little towards 1/2.
    if (albedo * albedo > q)
      lab.expect_near(method, point, khat, theory, 0.3);
    else
      lab.expect_between(method, point, khat, -1, 0.3);
  }
}

inline constexpr Case kRouletteBelowTheSquare{"roulette-below-the-square", Kind::heavy_tails,
                                              "A heavy walk survives with 0.995 at most; where walks keep r of their "
                                              "throughput and 0.995 < r^2, the variance is infinite, "
                                              "and khat is -ln(r / q) / ln(q)",
                                              roulette_below_the_square};

}  // namespace etendue::stress
