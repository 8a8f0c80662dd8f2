// Means and variances of integrators in the integrating sphere (scene/builtin/integrating_sphere.h): a closed sphere of
// albedo rho whose emitter is a cap of area fraction a and radiance one. The geometry term between any two points is G
// = 1 / (4 R^2), and cosine-distributed directions hit the sphere uniformly.
//
// `path` combines BSDF sampling and light sampling. A hit of the cap by BSDF sampling has the density of a light sample
// times a at every vertex. Its weight is w = a^2 / (1 + a^2) with the power heuristic and w = a / (1 + a) with the
// balance heuristic. The contribution of a light sample is the constant a. The estimate of a path is the sum of rho^k
// (a (1 - w) + w [hit]) over its vertices; `path-pure` has w = 1.
#include <gtest/gtest.h>

#include <cmath>

#include "support/integrator_scenes.h"

namespace etendue::integrating_sphere_test {
namespace {

using scene::Cap;
using test::with;
using test::with_integrator;

// Moments of the estimate of one path.
struct Moments {
  double mean, variance;
};

Moments theory(double a, double rho, double w, Cap cap) {
  if (cap == Cap::reflecting) return {rho * a / (1 - rho), w * w * a * (1 - a) * rho * rho / (1 - rho * rho)};
  // X = rho (c + w) with probability a, where the path ends on the cap, else rho (c + X').
  const double mean = rho * a / (1 - rho * (1 - a)), c = a * (1 - w);
  const double square =
      rho * rho * (a * (c + w) * (c + w) + (1 - a) * (c * c + 2 * c * mean)) / (1 - rho * rho * (1 - a));
  return {mean, square - mean * mean};
}

// Tabulated closed form: mean and relative standard deviation of BSDF sampling alone with a black cap: mean rho a / (1
// - rho (1 - a)), variance rho^2 a / (1 - rho^2 (1 - a)) - mean^2.
TEST(IntegratingSphere, TheoryMatchesTabulatedValues) {
  constexpr double kTable[][4] = {{0.01, 0.5, 0.00990099, 5.735},
                                  {0.01, 0.8, 0.03846154, 3.288},
                                  {0.001, 0.8, 0.00398406, 10.53},
                                  {0.1, 0.5, 0.09090909, 1.704}};
  for (const auto& [a, rho, mean, deviation] : kTable) {
    const Moments black = theory(a, rho, 1, Cap::black);
    EXPECT_NEAR(black.mean, mean, 1e-8);
    EXPECT_NEAR(std::sqrt(black.variance) / black.mean, deviation, 6e-4 * deviation);
    // With light sampling alone the standard deviation is smaller by exactly rho a / (1 - rho).
    EXPECT_NEAR(std::sqrt(theory(a, rho, 0, Cap::black).variance / black.variance), rho * a / (1 - rho), 1e-9);
  }
}

TEST(IntegratingSphere, CapHasItsAreaFraction) {
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

struct Strategy {
  const char *integrator, *heuristic;
  double (*weight)(double a);
};
constexpr Strategy kStrategies[] = {{"path-pure", "power", [](double) { return 1.0; }},
                                    {"path", "balance", [](double a) { return a / (1 + a); }},
                                    {"path", "power", [](double a) { return a * a / (1 + a * a); }},
                                    {"path", "maximum", [](double) { return 0.0; }},
                                    {"path", "constant", [](double) { return 0.5; }},
                                    {"path", "cutoff", [](double) { return 0.0; }},
                                    {"path", "partition", [](double) { return 0.0; }}};

// Variance of the pixel means, and its standard error.
struct TileVariance {
  double variance = 0, error = 0;
};

TileVariance pixel_variance(const film::Film& film, double mean) {
  double squares = 0, fourths = 0;
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x) {
      const double square = sqr(static_cast<double>(film.mean(x, y).r) - mean);
      squares += square;
      fourths += square * square;
    }
  const double n = static_cast<double>(film.width()) * film.height(), variance = squares / n;
  return {variance, std::sqrt((fourths / n - variance * variance) / n)};
}

// Compares the theoretical moments of single pixel samples with images that differ in their seeds. The tolerances are
// 4.5 standard errors plus the effect of the tessellation. The false-alarm rate is one in 150,000 comparisons.
constexpr double kSigmas = 4.5, kTriangles = 2e-4, kTriangleVariance = 1e-4;

void expect_moments(const render::Document& document, uint32_t samples, const Moments& expected,
                    const std::string& what, int images = 1) {
  auto d = document;
  double sum = 0, squared_error = 0;
  TileVariance variance_of_pixels;
  for (; d.seed < static_cast<uint64_t>(images); ++d.seed) {
    const film::Film film = test::rendered(d, samples);
    const auto mean = test::mean_of(film);
    sum += mean.value / images;
    squared_error += sqr(mean.standard_error / images);
    const TileVariance one = pixel_variance(film, expected.mean);
    variance_of_pixels.variance += one.variance / images;
    variance_of_pixels.error += sqr(one.error / images);
  }
  EXPECT_NEAR(sum, expected.mean, kSigmas * std::sqrt(squared_error) + kTriangles * expected.mean) << what;
  EXPECT_NEAR(samples * variance_of_pixels.variance, expected.variance,
              samples * kSigmas * std::sqrt(variance_of_pixels.error) + kTriangleVariance * sqr(expected.mean))
      << what;
}

TEST(IntegratingSphere, MeanAndVarianceOfPathTracing) {
  struct Point {
    double a;
    float rho;
    Cap cap;
  };
  for (const Point& p :
       {Point{0.1, 0.5f, Cap::reflecting}, Point{0.1, 0.5f, Cap::black}, Point{0.01, 0.5f, Cap::reflecting}})
    for (const Strategy& strategy : kStrategies) {
      const auto d = with(with_integrator(test::integrating_sphere(p.a, p.rho, p.cap), strategy.integrator),
                          "path.heuristic", strategy.heuristic);
      expect_moments(d, 8, theory(p.a, p.rho, strategy.weight(p.a), p.cap),
                     std::string(strategy.integrator) + ' ' + strategy.heuristic + " a " + std::to_string(p.a));
    }
}

// n light samples have the density of one times n.
TEST(IntegratingSphere, SeveralLightSamples) {
  constexpr double kShare = 0.3;
  constexpr float kAlbedo = 0.5f;
  for (const int n : {2, 4}) {
    const double squares = kShare * kShare, w = squares / (squares + n * n);
    const auto d =
        with(with_integrator(test::integrating_sphere(kShare, kAlbedo), "path"), "light-samples", std::to_string(n));
    for (const char* lights : {"one", "every"})
      expect_moments(with(d, "lights", lights), 8, theory(kShare, kAlbedo, w, Cap::reflecting),
                     std::to_string(n) + " light samples, " + lights);
  }
}

// Russian roulette of survival probability q at every vertex, all direct light from light samples: the estimate is X =
// rho a + rho / q X' with probability q, else rho a. Its second moment is finite if rho^2 < q [Lang, eq. 9.10].
TEST(IntegratingSphere, RulesOfRussianRoulette) {
  struct Rule {
    const char *rule, *survival, *minimum;
    double q;
  };
  constexpr double kShare = 0.1, kRho = 0.5;
  auto d = with_integrator(test::integrating_sphere(kShare, static_cast<float>(kRho)), "path");
  d = with(with(d, "heuristic", "partition"), "roulette-start", "1");
  for (const Rule& rule :
       {Rule{"constant", "0.8", "0", 0.8}, Rule{"constant", "0.5", "0", 0.5}, Rule{"albedo", "0.9", "0", 0.5},
        Rule{"albedo", "0.9", "0.7", 0.7}, Rule{"throughput", "0.9", "0.7", 0.7}}) {
    const double c = kRho * kShare, mean = c / (1 - kRho);
    const double square = (c * c + 2 * c * kRho * mean) / (1 - kRho * kRho / rule.q);
    const auto changed =
        with(with(with(d, "survival-rule", rule.rule), "survival", rule.survival), "least-survival", rule.minimum);
    expect_moments(changed, 16, {mean, square - mean * mean},
                   std::string(rule.rule) + ", q = " + std::to_string(rule.q));
  }
}

// Guided samples have other weights, so only the mean is known. The guides of the last samples have been learned in five
// iterations. The cap is found by light samples and by guided directions, which learn where it is.
TEST(IntegratingSphere, GuidedPathTracing) {
  for (const Cap cap : {Cap::reflecting, Cap::black})
    for (const double share : {0.1, 0.01}) {
      const Moments expected = theory(share, 0.5, 0, cap);
      double sum = 0, squared_error = 0;
      constexpr int kImages = 4;
      for (uint64_t seed = 0; seed < kImages; ++seed) {
        auto d = with_integrator(test::integrating_sphere(share, 0.5f, cap, 16), "path-guided");
        d.seed = seed;
        const auto mean = test::mean_of(test::rendered(d, 126));
        sum += mean.value / kImages;
        squared_error += sqr(mean.standard_error / kImages);
      }
      const double standard_error = std::sqrt(squared_error);
      EXPECT_LT(standard_error, 0.02 * expected.mean);
      EXPECT_NEAR(sum, expected.mean, kSigmas * standard_error + kTriangles * expected.mean) << share;
    }
}

// The direct light rho a is the same for every sample.
TEST(IntegratingSphere, ClassicIntegratorsAreConstant) {
  constexpr double kShare = 0.1, kAlbedo = 0.5;
  for (const char* method : {"raycast", "appel", "whitted"})
    expect_moments(with_integrator(test::integrating_sphere(kShare, kAlbedo), method), 4, {kAlbedo * kShare, 0},
                   method);
}

// N branches at the first vertex are N paths that share the pixel sample. For the MIS weight, each hits the cap with N
// times the density at that vertex. Their mean has 1/N of the variance.
TEST(IntegratingSphere, BranchesDivideTheVariance) {
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

// Splitting has the weights of one BSDF sample.
TEST(IntegratingSphere, SplittingDividesTheVariance) {
  constexpr double kShare = 0.3, kAlbedo = 0.5;
  constexpr int kBranches = 4;
  const double w = sqr(kShare) / (1 + sqr(kShare));
  const Moments path = theory(kShare, kAlbedo, w, Cap::reflecting);
  auto d = with_integrator(test::integrating_sphere(kShare, kAlbedo), "distribution");
  d = with(with(d, "branching", "first-rough"), "branches-1", std::to_string(kBranches));
  expect_moments(d, 4, {path.mean, path.variance / kBranches}, "splitting");
}

constexpr int kSide = 32, kPixels = kSide * kSide;

// Images with paths of at most kLongest edges: the mean, and the sum of rho^(2k) over k = 1, 2, ....
constexpr int kLongest = 8;
double mean_of_short_paths(double a, double rho) { return a * rho * (1 - std::pow(rho, kLongest - 1)) / (1 - rho); }
double sum_of_squares(double rho) { return rho * rho * (1 - std::pow(rho, 2 * (kLongest - 1))) / (1 - rho * rho); }
render::Document short_paths(const std::string& integrator, double a, double rho) {
  const auto d =
      with_integrator(test::integrating_sphere(a, static_cast<float>(rho), Cap::reflecting, kSide), integrator);
  return with(d, "max-depth", std::to_string(kLongest));
}

// The camera in the sphere: pixels per solid angle in a direction whose intersection with the image plane at distance
// one is at distance `length`, for a pinhole.
const double kHalfImage = std::tan(0.5);
double pixels_per_solid_angle(double length) { return kPixels / (4 * sqr(kHalfImage)) * length * sqr(length); }

// The mean of value(x, y) over the image, with x and y from -kHalfImage to kHalfImage.
template <class Value>
double mean_over_image(Value&& value) {
  constexpr int kSteps = 64;
  double sum = 0;
  for (int j = 0; j < kSteps; ++j)
    for (int i = 0; i < kSteps; ++i)
      sum += value(kHalfImage * ((2 * i + 1.0) / kSteps - 1), kHalfImage * ((2 * j + 1.0) / kSteps - 1));
  return sum / (kSteps * kSteps);
}

// The vertices y_1, y_2, ... of a path from the cap are uniformly distributed on the sphere. A vertex in a pixel with I
// pixels per solid angle contributes 4 pi a rho^k I with probability 1 / (4 pi I). For one path per pixel and P pixels
// the variance is that of P independent rare events:
//
//   a^2 sum rho^(2k) (4 pi I - 1) / P
TEST(IntegratingSphere, LightTracing) {
  constexpr double kShare = 0.1, kAlbedo = 0.5;
  const double factor = mean_over_image([](double x, double y) {
    return (4 * double{kPi} * pixels_per_solid_angle(std::sqrt(1 + x * x + y * y)) - 1) / kPixels;
  });
  expect_moments(short_paths("light", kShare, kAlbedo), 128,
                 {mean_of_short_paths(kShare, kAlbedo), sqr(kShare) * sum_of_squares(kAlbedo) * factor}, "light");
}

// The same for paths that must hit a lens of area A. Directions from y_k are cosine-distributed. A pixel is hit through
// the lens with probability A cos / (4 pi^2 I) and then receives 4 pi^2 a rho^k I / (A cos).
TEST(IntegratingSphere, PureLightTracing) {
  constexpr double kShare = 0.1, kAlbedo = 0.5, kRadius = 0.3;
  auto d = short_paths("light-pure", kShare, kAlbedo);
  d = with(with(d, "camera.lens-radius", std::to_string(kRadius)), "camera.focus-distance", "1");
  const double area = double{kPi} * sqr(kRadius);
  const double factor = mean_over_image([&](double x, double y) {
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
  expect_moments(d, 512, {mean_of_short_paths(kShare, kAlbedo), sqr(kShare) * sum_of_squares(kAlbedo) * factor},
                 "light-pure");
}

// Of the techniques (s, t) of a path with k edges, the k - 1 connections in space have the constant contribution a
// rho^(k-1) and equal densities. The cap is hit (s = 0) with a times this density, and the pixel (t = 1) with r = P /
// (4 pi I) times this density. The weights are ratios of these densities to the power of the heuristic. The maximum
// heuristic selects one of k - 1 equal densities by rounding and has no theory.
TEST(IntegratingSphere, BidirectionalPathTracing) {
  constexpr double kShare = 0.1, kAlbedo = 0.5;
  const auto place = short_paths("bdpt", kShare, kAlbedo);
  for (const auto& [heuristic, power] : {std::pair{"balance", 1}, std::pair{"power", 2}})
    for (const bool splats : {false, true}) {
      const double variance = mean_over_image([&](double x, double y) {
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

// Unweighted techniques: every connection contributes L_e a rho^(s + t - 2), except for vertices so close together that
// the tessellation matters. A hit (s = 0) has the same mean and probability a.
TEST(IntegratingSphere, ContributionOfEachConnectionIsConstant) {
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

// Each virtual light y_j contributes a rho^(j+1) / n to every pixel. With Russian roulette the number of lights of one
// of n paths has mean 1 / (1 - rho) and variance rho / (1 - rho)^2. Every pixel uses its own paths.
TEST(IntegratingSphere, VirtualLights) {
  constexpr double kShare = 0.1, kAlbedo = 0.5;
  constexpr int kPathsOfAPixel = 4;
  auto d = with_integrator(test::integrating_sphere(kShare, kAlbedo, Cap::reflecting, 16), "igi");
  d = with(with(d, "interleave", "16"), "light-paths", std::to_string(256 * kPathsOfAPixel));
  const double variance = sqr(kShare * sqr(kAlbedo) / (1 - kAlbedo)) * kAlbedo / kPathsOfAPixel;
  expect_moments(d, 4, {kAlbedo * kShare / (1 - kAlbedo), variance}, "igi", 8);
}

// An estimate of k - 1 photons over the disc of the k-th has relative variance 1 / (k - 2). The discs are smaller than
// a pixel and all samples are at pixel centres, so that each pixel of an image has one estimate.
TEST(IntegratingSphere, NearestPhotonsHaveTheirRelativeVariance) {
  constexpr double kShare = 0.1, kAlbedo = 0.5, kMean = kAlbedo * kShare / (1 - kAlbedo);
  auto d = with_integrator(test::integrating_sphere(kShare, kAlbedo, Cap::reflecting, 32), "photonmap");
  d.filter = film::FilterKind::centre;
  d = with(with(with(d, "mode", "direct"), "photons", "100000"), "radius", "0");
  for (const int nearest : {5, 10})
    expect_moments(with(d, "nearest", std::to_string(nearest)), 1, {kMean, sqr(kMean) / (nearest - 2)},
                   std::to_string(nearest) + " photons", 2);
}

// A disc of radius r contains n r^2 / (4 (1 - rho)) of the photons that n paths leave, which are rare events. The
// squared radius of the i-th of N samples of a half-buffer is q_i = prod (j + alpha) / (j + 1) times the first. The
// variance is that of the mean of 1 / q_i over N and falls as N^-alpha [Knaus and Zwicker 2011].
TEST(IntegratingSphere, PhotonsWithinARadius) {
  constexpr double kShare = 0.1, kAlbedo = 0.5, kMean = kAlbedo * kShare / (1 - kAlbedo);
  constexpr double kPhotons = 40'000, kRadius = 0.4;  // radius in pixels
  auto d = with_integrator(test::integrating_sphere(kShare, kAlbedo, Cap::reflecting, 32), "sppm");
  d.filter = film::FilterKind::centre;
  d = with(with(with(d, "connect", "off"), "photons", "40000"), "radius", std::to_string(kRadius));
  const double pixel = 2 * kHalfImage / 32;
  const double photons = kPhotons * sqr(kRadius * pixel) / (4 * (1 - kAlbedo));
  for (const auto& [alpha, samples_per_half] : {std::pair{1.0, 8}, std::pair{0.5, 2}, std::pair{0.5, 16}}) {
    double shrunk = 1, growth = 0;
    for (int i = 0; i < samples_per_half; ++i) {
      growth += 1 / shrunk / samples_per_half;
      shrunk *= (i + 1 + alpha) / (i + 2);
    }
    const auto made = with(d, "alpha", std::to_string(alpha));
    expect_moments(
        made, static_cast<uint32_t>(2 * samples_per_half), {kMean, growth * sqr(kMean) / photons},
        "alpha " + std::to_string(alpha) + ", " + std::to_string(samples_per_half) + " samples per half-buffer");
  }
}

}  // namespace
}  // namespace etendue::integrating_sphere_test
