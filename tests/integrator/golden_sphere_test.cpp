// Means and variances in the golden sphere, as scene/golden_sphere.h has them.
//
// For `path` both ways to the cap are combined. The directions of the BSDF are uniform over the sphere, so that a hit
// has the density of a light sample times a at every vertex: with the power heuristic it weighs w = a^2 / (1 + a^2),
// with the balance heuristic a / (1 + a), and a light sample is a constant a. A walk is then worth the sum over its
// vertices of rho^k (a (1 - w) + w [hit]); `path-pure` has w = 1.
#include <gtest/gtest.h>

#include <cmath>

#include "support/scenes.h"

namespace etendue {
namespace {

using scene::Cap;

// Of one walk.
struct Moments {
  double mean, variance;
};

Moments theory(double a, double rho, double w, Cap cap) {
  if (cap == Cap::reflecting) return {rho * a / (1 - rho), w * w * a * (1 - a) * rho * rho / (1 - rho * rho)};
  // X = rho (c + w) with probability a, where the walk ends on the cap, else rho (c + X').
  const double mean = rho * a / (1 - rho * (1 - a)), c = a * (1 - w);
  const double square =
      rho * rho * (a * (c + w) * (c + w) + (1 - a) * (c * c + 2 * c * mean)) / (1 - rho * rho * (1 - a));
  return {mean, square - mean * mean};
}

// Of the table of closed forms: mean and relative standard deviation of hits alone under a black cap.
TEST(GoldenSphere, TheoryIsThatOfTheTable) {
  constexpr double kTable[][4] = {{0.01, 0.5, 0.00990099, 5.735},
                                  {0.01, 0.8, 0.03846154, 3.288},
                                  {0.001, 0.8, 0.00398406, 10.53},
                                  {0.1, 0.5, 0.09090909, 1.704}};
  for (const auto& [a, rho, mean, deviation] : kTable) {
    const Moments black = theory(a, rho, 1, Cap::black);
    EXPECT_NEAR(black.mean, mean, 1e-8);
    EXPECT_NEAR(std::sqrt(black.variance) / black.mean, deviation, 6e-4 * deviation);
    // Connections alone: smaller by rho a / (1 - rho) exactly.
    EXPECT_NEAR(std::sqrt(theory(a, rho, 0, Cap::black).variance / black.variance), rho * a / (1 - rho), 1e-9);
  }
}

TEST(GoldenSphere, TheCapHasItsShare) {
  for (const double share : {0.5, 0.1, 0.01, 1e-3, 1e-4}) {
    const auto scene = scene::golden_sphere(share, 0.5f);
    double area[2] = {0, 0};
    for (size_t i = 0; i < 2; ++i) {
      const Mesh& mesh = *scene.meshes[i].primitives[0].mesh;
      for (const auto& t : mesh.triangles) {
        const Vec3 a = mesh.positions[t[0]], n = glm::cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a);
        EXPECT_LT(glm::dot(n, a), 0);
        EXPECT_GT(-glm::dot(glm::normalize(n), a), 1 - 1.01e-4f);
        area[i] += 0.5 * glm::length(n);
      }
    }
    EXPECT_NEAR(area[0] / (area[0] + area[1]), share, 1e-4 * share) << share;
  }
}

struct Way {
  const char *integrator, *heuristic;
  double (*weight)(double a);
};
constexpr Way kWays[] = {{"path-pure", "power", [](double) { return 1.0; }},
                         {"path", "balance", [](double a) { return a / (1 + a); }},
                         {"path", "power", [](double a) { return a * a / (1 + a * a); }}};

// Of the means of pixels, and the standard error of that.
struct Spread {
  double variance = 0, error = 0;
};

Spread spread_of(const film::Film& film, double mean) {
  double squares = 0, fourths = 0;
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x) {
      const double square = sqr(static_cast<double>(film.mean(x, y).r) - mean);
      squares += square, fourths += square * square;
    }
  const double n = static_cast<double>(film.width()) * film.height(), variance = squares / n;
  return {variance, std::sqrt((fourths / n - variance * variance) / n)};
}

// Within 4.5 standard errors and what the triangles change: one false alarm in 150,000 comparisons.
TEST(GoldenSphere, MeanAndVarianceOfWalks) {
  constexpr uint32_t kSamples = 16;
  constexpr double kSigmas = 4.5, kTriangles = 2e-4, kTriangleVariance = 1e-4;
  struct Point {
    double a;
    float rho;
    Cap cap;
  };
  for (const Point& p :
       {Point{0.1, 0.5f, Cap::reflecting}, Point{0.1, 0.5f, Cap::black}, Point{0.01, 0.5f, Cap::reflecting}})
    for (const Way& way : kWays) {
      auto d = test::golden_sphere(p.a, p.rho, p.cap);
      d.method.integrator = way.integrator;
      d = *render::with(d, "path.heuristic", std::string(way.heuristic));
      const film::Film film = test::rendered(d, kSamples);
      const auto mean = test::mean_of(film);
      const Moments expected = theory(p.a, p.rho, way.weight(p.a), p.cap);
      const std::string what = std::string(way.integrator) + ' ' + way.heuristic + " a " + std::to_string(p.a);
      EXPECT_NEAR(mean.value, expected.mean, kSigmas * mean.standard_error + kTriangles * expected.mean) << what;
      const Spread spread = spread_of(film, mean.value);
      EXPECT_NEAR(kSamples * spread.variance, expected.variance,
                  kSamples * kSigmas * spread.error + kTriangleVariance * sqr(expected.mean))
          << what;
    }
}

}  // namespace
}  // namespace etendue
