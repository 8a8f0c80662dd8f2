// Russian roulette that terminates paths faster than the square of their throughput decreases. [Arvo and Kirk 1990]
#pragma once
#include <cmath>

#include "stress/case.h"
#include "transport/wavefront/path_estimators.h"

namespace etendue::stress {

inline void roulette_below_the_square(TestContext& test) {
  for (const double albedo : {0.9, 0.99, 0.999}) {
    const auto furnace = scene::furnace(static_cast<float>(albedo));
    auto d = test.document(furnace, look_at({0.2f, 0, 0}, {0, 0, 1}, {0, 1, 0}, 1));
    const std::string integrator = "path-pure:sampler=random:roulette-start=1";
    const double khat = test.tail(TestContext::with_method(d, integrator), 64).khat.value_or(-1);
    const std::string point = "khat at albedo " + number(albedo);
    // A path of n segments has the probability q^n and the weight (r / q)^n.
    const double q = transport::kMaxSurvivalAboveOne, theory = -std::log(albedo / q) / std::log(q);
    // The standard error of the fit is 0.06 here, and its prior shifts it slightly towards 1/2.
    if (albedo * albedo > q)
      test.expect_near(integrator, point, khat, theory, 0.3);
    else
      test.expect_between(integrator, point, khat, -1, 0.3);
  }
}

inline constexpr Case kRouletteBelowTheSquare{
    .name = "roulette-below-the-square",
    .kind = Kind::heavy_tails,
    .theory =
        "A path of a weight above one survives with a probability of at most q = 0.995. If the throughput "
        "is scaled by r per bounce and q < r^2, the variance is infinite and khat is -ln(r / q) / ln(q)",
    .run = roulette_below_the_square};

}  // namespace etendue::stress
