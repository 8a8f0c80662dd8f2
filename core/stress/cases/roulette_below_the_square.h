// Roulette that ends walks faster than twice their throughput falls.
#pragma once
#include <cmath>

#include "measure/tail.h"
#include "stress/case.h"
#include "transport/gather.h"

namespace etendue::stress {

// The shape of the tail of single samples: pixels of a furnace are all alike.
inline double khat_of_samples(Lab& lab, render::Document d) {
  d.width = d.height = 192;
  d.filter = film::FilterKind::box;
  const film::Film film = lab.render(d, 1);
  measure::TailAccumulator tail;
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x) tail.add(average(film.mean(x, y)));
  return tail.report().khat.value_or(-1);
}

inline void roulette_below_the_square(Lab& lab) {
  for (const double albedo : {0.9, 0.99}) {
    const auto furnace = scene::furnace(static_cast<float>(albedo));
    const auto d = lab.document(furnace, look_at({0.2f, 0, 0}, {0, 0, 1}, {0, 1, 0}, 1));
    const std::string method = "path-pure:sampler=random:roulette-start=1";
    const double khat = khat_of_samples(lab, Lab::with_method(d, method));
    const std::string point = "khat at albedo " + number(albedo);
    // A walk of n edges has the probability q^n and the weight (r / q)^n.
    const double q = transport::kMaxSurvival, theory = -std::log(albedo / q) / std::log(q);
    // The fit scatters by 0.06 at so many samples, and is drawn a little towards 1/2.
    if (albedo > q)
      lab.expect_near(method, point, khat, theory, 0.3);
    else
      lab.expect_between(method, point, khat, -1, 0.3);
  }
}

inline constexpr Case kRouletteBelowTheSquare{"roulette-below-the-square", Kind::heavy_tails,
                                              "Survival is never more than 0.95; where walks keep r of their "
                                              "throughput and 0.95 < r^2, the variance is infinite, "
                                              "and khat is -ln(r / q) / ln(q)",
                                              roulette_below_the_square};

}  // namespace etendue::stress
