// Transmittance estimators of heterogeneous media: variance, cost, and their product, for random rays through a density.
//
//   transmittance_bench [SAMPLES]
//
// For each density and extinction coefficient: the standard deviation of an estimate, its processor time, and the error at
// equal time relative to delta tracking. Below 1 is better.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "medium/heterogeneous_medium.h"

namespace {

using namespace etendue;

struct Measurement {
  double deviation = 0;  // root of the mean variance over the rays
  double seconds = 0;    // per estimate
};

// Between random points on two sides of the unit cube.
RaySpan random_span(RandomStream& random) {
  const float ay = random.next(), az = random.next(), by = random.next();
  const Vec3 a(0, ay, az), b(1, by, random.next());
  return {a, b - a, 0, 1};
}

Measurement measure(const HeterogeneousMedium& medium, TransmittanceEstimator estimator, int rays) {
  constexpr int kPerRay = 64;
  RandomStream choice(1), random(2);
  double variance = 0;
  const std::clock_t start = std::clock();
  for (int i = 0; i < rays; ++i) {
    const RaySpan span = random_span(choice);
    double sum = 0, squares = 0;
    for (int k = 0; k < kPerRay; ++k) {
      const auto t = static_cast<double>(estimated_transmittance(medium, span, estimator, random).g);
      sum += t;
      squares += t * t;
    }
    variance += (squares - sum * sum / kPerRay) / (kPerRay - 1);
  }
  const double elapsed = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  return {std::sqrt(std::max(variance / rays, 0.0)), elapsed / rays / kPerRay};
}

}  // namespace

int main(int argc, char** argv) {
  const int rays = argc > 1 ? std::max(1, std::atoi(argv[1])) : 400;
  std::printf("%-12s %8s  %-24s %10s %12s %14s\n", "density", "sigma_t", "estimator", "deviation", "ns/estimate",
              "error, delta=1");
  for (const char* name : {"linear", "ball", "cloud"})
    for (const float extinction : {0.3f, 3.0f, 30.0f}) {
      MediumDescription description;
      description.scattering = Rgb(extinction);
      const HeterogeneousMedium medium(description, Rgb(0), *make_density(name)->grid(), Mat4(1));
      double of_delta = 0;
      for (size_t i = 0; i < Options<TransmittanceEstimator>::kOptions.size(); ++i) {
        const Measurement m = measure(medium, static_cast<TransmittanceEstimator>(i), rays);
        const double error = m.deviation * std::sqrt(m.seconds);
        if (i == 0) of_delta = error;
        std::printf("%-12s %8.1f  %-24s %10.5f %12.0f %14.3f\n", name, static_cast<double>(extinction),
                    Options<TransmittanceEstimator>::kOptions[i].label, m.deviation, 1e9 * m.seconds, error / of_delta);
      }
    }
}
