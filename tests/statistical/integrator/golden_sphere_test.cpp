// Means and variances in the golden sphere, as scene/integrating_sphere.h has them.                digest 8-10: O1, O2, O18
//
// For `path` both ways to the cap are combined. The directions of the BSDF are uniform over the sphere, so that a hit
// has the density of a light sample times a at every vertex: with the power heuristic it weighs w = a^2 / (1 + a^2),
// with the balance heuristic a / (1 + a), and a light sample is a constant a. A walk is then worth the sum over its
// vertices of rho^k (a (1 - w) + w [hit]); `path-pure` has w = 1.
#include <gtest/gtest.h>

#include <cmath>

#include "support/integrator_scenes.h"

namespace etendue {
namespace {

using scene::Cap;
using test::with_integrator;
using test::with;

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
    const auto scene = scene::integrating_sphere(share, 0.5f);
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
                         {"path", "power", [](double a) { return a * a / (1 + a * a); }},
                         {"path", "maximum", [](double) { return 0.0; }}};

// Of the means of pixels, and the standard error of that.
struct TileVariance {
  double variance = 0, error = 0;
};

TileVariance spread_of(const film::Film& film, double mean) {
  double squares = 0, fourths = 0;
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x) {
      const double square = sqr(static_cast<double>(film.mean(x, y).r) - mean);
      squares += square, fourths += square * square;
    }
  const double n = static_cast<double>(film.width()) * film.height(), variance = squares / n;
  return {variance, std::sqrt((fourths / n - variance * variance) / n)};
}

// What of single samples of pixels is known, against pictures of several samples that differ in their seeds: within 4.5
// standard errors and what the triangles change. One false alarm in 150,000 comparisons.
constexpr double kSigmas = 4.5, kTriangles = 2e-4, kTriangleVariance = 1e-4;

void expect_moments(const render::Document& document, uint32_t samples, const Moments& expected,
                    const std::string& what, int pictures = 1) {
  auto d = document;
  double sum = 0, squared_error = 0;
  TileVariance spread;
  for (; d.seed < static_cast<uint64_t>(pictures); ++d.seed) {
    const film::Film film = test::rendered(d, samples);
    const auto mean = test::mean_of(film);
    sum += mean.value / pictures, squared_error += sqr(mean.standard_error / pictures);
    const TileVariance one = spread_of(film, expected.mean);
    spread.variance += one.variance / pictures, spread.error += sqr(one.error / pictures);
  }
  EXPECT_NEAR(sum, expected.mean, kSigmas * std::sqrt(squared_error) + kTriangles * expected.mean) << what;
  EXPECT_NEAR(samples * spread.variance, expected.variance,
              samples * kSigmas * std::sqrt(spread.error) + kTriangleVariance * sqr(expected.mean))
      << what;
}

TEST(GoldenSphere, MeanAndVarianceOfWalks) {
  struct Point {
    double a;
    float rho;
    Cap cap;
  };
  for (const Point& p :
       {Point{0.1, 0.5f, Cap::reflecting}, Point{0.1, 0.5f, Cap::black}, Point{0.01, 0.5f, Cap::reflecting}})
    for (const Way& way : kWays) {
      const auto d = with(with_integrator(test::integrating_sphere(p.a, p.rho, p.cap), way.integrator), "path.heuristic", way.heuristic);
      expect_moments(d, 8, theory(p.a, p.rho, way.weight(p.a), p.cap),
                     std::string(way.integrator) + ' ' + way.heuristic + " a " + std::to_string(p.a));
    }
}

// Direct light alone, rho a, is the same for every sample.
TEST(GoldenSphere, ClassicMethodsAreConstant) {
  constexpr double kShare = 0.1, kAlbedo = 0.5;
  for (const char* method : {"raycast", "appel", "whitted"})
    expect_moments(with_integrator(test::integrating_sphere(kShare, kAlbedo), method), 4, {kAlbedo * kShare, 0}, method);
}

// N branches at the first vertex are N walks that share the pixel: each finds the cap with N times the density there,
// for the weight, and their mean has a part in N of the variance.
TEST(GoldenSphere, BranchesDivideTheVariance) {
  constexpr double kShare = 0.1, kAlbedo = 0.5;
  const auto place = with_integrator(test::integrating_sphere(kShare, kAlbedo), "distribution");
  for (const int branches : {2, 5})
    for (const bool connected : {false, true}) {
      const auto weight = [&](double density) { return connected ? sqr(density) / (1 + sqr(density)) : 1; };
      const double hit = sqr(kAlbedo) * kShare * (1 - kShare);
      const double later = theory(kShare, kAlbedo, weight(kShare), Cap::reflecting).variance;
      const double variance = (sqr(weight(branches * kShare)) * hit + sqr(kAlbedo) * later) / branches;
      const auto d = with(with(place, "branches-1", std::to_string(branches)), "shadow-rays", connected ? "on" : "off");
      expect_moments(d, 4, {kAlbedo * kShare / (1 - kAlbedo), variance},
                     std::to_string(branches) + " branches, connected " + std::to_string(connected));
    }
}

constexpr int kSide = 32, kPixels = kSide * kSide;

// Pictures by paths of kLongest edges at most: the mean, and the sum of rho^(2k) over k = 1, 2, ....
constexpr int kLongest = 8;
double mean_of_short_paths(double a, double rho) { return a * rho * (1 - std::pow(rho, kLongest - 1)) / (1 - rho); }
double sum_of_squares(double rho) { return rho * rho * (1 - std::pow(rho, 2 * (kLongest - 1))) / (1 - rho * rho); }
render::Document short_paths(const std::string& integrator, double a, double rho) {
  const auto d = with_integrator(test::integrating_sphere(a, static_cast<float>(rho), Cap::reflecting, kSide), integrator);
  return with(d, "max-depth", std::to_string(kLongest));
}

// The camera of the sphere: pixels to a solid angle where the direction to a point of the picture at distance one is as
// long as `length`, as a pinhole sees it.
const double kHalfPicture = std::tan(0.5);
double pixels_per_solid_angle(double length) { return kPixels / (4 * sqr(kHalfPicture)) * length * sqr(length); }

// The mean over the picture of value(x, y), both from -kHalfPicture to kHalfPicture.
template <class Value>
double mean_over_picture(Value&& value) {
  constexpr int kSteps = 64;
  double sum = 0;
  for (int j = 0; j < kSteps; ++j)
    for (int i = 0; i < kSteps; ++i)
      sum += value(kHalfPicture * ((2 * i + 1.0) / kSteps - 1), kHalfPicture * ((2 * j + 1.0) / kSteps - 1));
  return sum / (kSteps * kSteps);
}

// A walk from the cap has its vertices y_1, y_2, ... anywhere in the sphere, each with the same chance. Where one falls
// into a pixel that has I pixels to a solid angle it is worth 4 pi a rho^k I, with the probability 1 / (4 pi I): of one
// walk for each of P pixels the variance is that of so many rare events, which are independent,
//
//   a^2 sum rho^(2k) (4 pi I - 1) / P
TEST(GoldenSphere, LightTracing) {
  constexpr double kShare = 0.1, kAlbedo = 0.5;
  const double picture = mean_over_picture([](double x, double y) {
    return (4 * double{kPi} * pixels_per_solid_angle(std::sqrt(1 + x * x + y * y)) - 1) / kPixels;
  });
  expect_moments(short_paths("light", kShare, kAlbedo), 128,
                 {mean_of_short_paths(kShare, kAlbedo), sqr(kShare) * sum_of_squares(kAlbedo) * picture}, "light");
}

// The same where a walk has to end on a lens of area A: directions from y_k are those of a Lambertian surface, so that
// a pixel is hit through the lens with the probability A cos / (4 pi^2 I), and then worth 4 pi^2 a rho^k I / (A cos).
TEST(GoldenSphere, PureLightTracing) {
  constexpr double kShare = 0.1, kAlbedo = 0.5, kRadius = 0.3;
  auto d = short_paths("light-pure", kShare, kAlbedo);
  d = with(with(d, "camera.lens-radius", std::to_string(kRadius)), "camera.focus-distance", "1");
  const double area = double{kPi} * sqr(kRadius);
  const double picture = mean_over_picture([&](double x, double y) {
    constexpr int kSteps = 16;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i)
      for (int j = 0; j < kSteps; ++j) {
        const double r = kRadius * std::sqrt((i + 0.5) / kSteps), phi = 2 * double{kPi} * (j + 0.5) / kSteps;
        const double length = std::sqrt(1 + sqr(x - r * std::cos(phi)) + sqr(y - r * std::sin(phi)));
        const double per_watt = pixels_per_solid_angle(length) * length / area;
        sum += (4 * sqr(double{kPi}) * per_watt - 1) / kPixels;
      }
    return sum / (kSteps * kSteps);
  });
  expect_moments(d, 512, {mean_of_short_paths(kShare, kAlbedo), sqr(kShare) * sum_of_squares(kAlbedo) * picture},
                 "light-pure");
}

// Of the techniques (s, t) that find a path of k edges, the k - 1 that connect in space are worth a rho^(k-1) whenever
// they are tried (digest: O2), all with the same density; the cap is hit with a times this density, s = 0, and the
// pixel with r = P / (4 pi I) times, t = 1. The weights are those of these densities to the power of the heuristic; the
// largest of k - 1 equal ones is chosen by rounding, and has no theory.
TEST(GoldenSphere, BidirectionalPathTracing) {
  constexpr double kShare = 0.1, kAlbedo = 0.5;
  const auto place = short_paths("bdpt", kShare, kAlbedo);
  for (const auto& [heuristic, power] : {std::pair{"balance", 1}, std::pair{"power", 2}})
    for (const bool splats : {false, true}) {
      const double variance = mean_over_picture([&](double x, double y) {
        const double density = 4 * double{kPi} * pixels_per_solid_angle(std::sqrt(1 + x * x + y * y)) / kPixels;
        const double hit = std::pow(kShare, power), splat = splats ? std::pow(density, -power) : 0;
        double sum = 0;
        for (int k = 2; k <= kLongest; ++k) {
          const double all = k - 1 + hit + splat, weight = sqr(std::pow(kAlbedo, k - 1) / all);
          sum += weight * (sqr(hit) * kShare * (1 - kShare) + sqr(kShare * splat) * (density - 1.0 / kPixels));
        }
        return sum;
      });
      const auto d = with(with(place, "heuristic", heuristic), "without", splats ? "" : "*,1");
      expect_moments(d, 32, {mean_of_short_paths(kShare, kAlbedo), variance},
                     std::string(heuristic) + (splats ? ", all" : ", without t = 1"));
    }
}

// Each technique by itself, in full: L_e a rho^(s + t - 2) for every sample where two vertices are connected, but for
// those that are so close that a triangle is no sphere. A hit, s = 0, has the same mean, with the chance a.
TEST(GoldenSphere, EachConnectionIsConstant) {
  constexpr double kShare = 0.02, kAlbedo = 0.7, kCloseTogether = 1e-3;
  const auto place = with(short_paths("bdpt", kShare, kAlbedo), "weighted", "off");
  const auto weight = [](int s, int t) { return kShare * std::pow(kAlbedo, s + t - 2); };
  for (int s = 1; s <= 3; ++s)
    for (int t = 2; t <= 3; ++t) {
      const std::string technique = std::to_string(s) + ',' + std::to_string(t);
      const auto mean = test::mean_of(test::rendered(with(place, "only", technique), 4));
      EXPECT_NEAR(mean.value, weight(s, t), 4.5 * mean.standard_error + kTriangles * weight(s, t)) << technique;
      EXPECT_LT(4 * mean.variance, kCloseTogether * sqr(weight(s, t))) << technique;
    }
  expect_moments(with(place, "only", "0,4"), 64, {weight(0, 4), sqr(weight(0, 4)) * (1 - kShare) / kShare}, "0,4");
}

// Each virtual light y_j is worth a rho^(j+1) / n in all pixels, but for roulette: the number of lights on one of n
// paths is 1 / (1 - rho) in the mean with the variance rho / (1 - rho)^2. Every pixel has paths of its own.
TEST(GoldenSphere, VirtualLights) {
  constexpr double kShare = 0.1, kAlbedo = 0.5;
  constexpr int kPathsOfAPixel = 4;
  auto d = with_integrator(test::integrating_sphere(kShare, kAlbedo, Cap::reflecting, 16), "igi");
  d = with(with(d, "interleave", "16"), "light-paths", std::to_string(256 * kPathsOfAPixel));
  const double variance = sqr(kShare * sqr(kAlbedo) / (1 - kAlbedo)) * kAlbedo / kPathsOfAPixel;
  expect_moments(d, 4, {kAlbedo * kShare / (1 - kAlbedo), variance}, "igi", 8);
}

// k - 1 photons over the disc of the k-th: a relative variance of 1 / (k - 2). Discs are smaller than pixels, samples
// all in the middle, so that a picture has one estimate for each pixel.
TEST(GoldenSphere, NearestPhotons) {
  constexpr double kShare = 0.1, kAlbedo = 0.5, kMean = kAlbedo * kShare / (1 - kAlbedo);
  auto d = with_integrator(test::integrating_sphere(kShare, kAlbedo, Cap::reflecting, 32), "photonmap");
  d.filter = film::FilterKind::centre;
  d = with(with(with(d, "mode", "direct"), "photons", "100000"), "radius", "0");
  for (const int nearest : {5, 10})
    expect_moments(with(d, "nearest", std::to_string(nearest)), 1, {kMean, sqr(kMean) / (nearest - 2)},
                   std::to_string(nearest) + " photons", 2);
}

// A disc of radius r holds n r^2 / (4 (1 - rho)) of the photons that n walks leave, as many rare events. Where the
// squared radius of the i-th of N samples of a half is q_i = prod (j + alpha) / (j + 1) of the first one's, the
// variance falls as the mean of 1 / q_i over N: as N^-alpha (Knaus & Zwicker 2011).
TEST(GoldenSphere, PhotonsWithinARadius) {
  constexpr double kShare = 0.1, kAlbedo = 0.5, kMean = kAlbedo * kShare / (1 - kAlbedo);
  constexpr double kPhotons = 40'000, kRadius = 0.4;  // pixels
  auto d = with_integrator(test::integrating_sphere(kShare, kAlbedo, Cap::reflecting, 32), "sppm");
  d.filter = film::FilterKind::centre;
  d = with(with(with(d, "connect", "off"), "photons", "40000"), "radius", std::to_string(kRadius));
  const double pixel = 2 * kHalfPicture / 32;
  const double photons = kPhotons * sqr(kRadius * pixel) / (4 * (1 - kAlbedo));
  for (const auto& [alpha, half] : {std::pair{1.0, 8}, std::pair{0.5, 2}, std::pair{0.5, 16}}) {
    double shrunk = 1, growth = 0;
    for (int i = 0; i < half; ++i) {
      growth += 1 / shrunk / half;
      shrunk *= (i + 1 + alpha) / (i + 2);
    }
    const auto made = with(d, "alpha", std::to_string(alpha));
    expect_moments(made, static_cast<uint32_t>(2 * half), {kMean, growth * sqr(kMean) / photons},
                   "alpha " + std::to_string(alpha) + ", " + std::to_string(half) + " samples of a half");
  }
}

}  // namespace
}  // namespace etendue
