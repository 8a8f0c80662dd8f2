// Figures of chapter 2: probability.
#include <cmath>
#include <numbers>

#include "equations/random_numbers.h"
#include "figures/tools.h"
#include "metrics/log_axis.h"

namespace etendue::figures {

using equations::RandomNumbers;

namespace {

double normal_density(double x, double deviation = 1) {
  const double t = x / deviation;
  return std::exp(-0.5 * t * t) / (deviation * std::sqrt(2 * std::numbers::pi));
}
double normal_cdf(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

FunctionCurve curve_of(const char* name, const std::function<double(double)>& f, double a, double b) {
  return {.name = name, .points = sampled(f, a, b, 400)};
}

// The number of pips of two dice: its probability.
double two_dice(int pips) { return (6 - std::abs(pips - 7)) / 36.0; }

Part mass_part(const char* title, int first, int last, double (*probability)(int)) {
  FunctionCurve bars{.name = "probability", .style = CurveStyle::bars, .points = {}};
  for (int x = first; x <= last + 1; ++x) bars.points.push_back({x - 0.5, x <= last ? probability(x) : 0});
  return curves_part(title, "x", "p", {bars});
}

Part step_part(const char* title, int first, int last, double (*probability)(int)) {
  FunctionCurve steps{.name = "F", .points = {{first - 1.0, 0}}};
  double sum = 0;
  for (int x = first; x <= last; ++x) {
    steps.points.push_back({static_cast<double>(x), sum});
    sum += probability(x);
    steps.points.push_back({static_cast<double>(x), sum});
  }
  steps.points.push_back({last + 1.0, sum});
  return curves_part(title, "x", "F", {steps});
}

// Running means of several runs of a random number with values from 1 to `sides`.
Part running_mean_part(const char* title, int sides, int first, double expected, uint64_t seed) {
  std::vector<FunctionCurve> curves;
  for (int run = 1; run <= 3; ++run) {
    RandomNumbers random(seed * 16 + static_cast<uint64_t>(sides * 4 + run));
    FunctionCurve curve{.name = "run " + std::to_string(run), .points = {}};
    double sum = 0;
    for (int n = 1; n <= 1000; ++n) {
      sum += first + std::floor(sides * random.uniform());
      curve.points.push_back({static_cast<double>(n), sum / n});
    }
    curves.push_back(std::move(curve));
  }
  curves.push_back(
      {.name = "expected value", .style = CurveStyle::dashed, .points = {{1, expected}, {1000, expected}}});
  return curves_part(title, "throws", "mean", std::move(curves));
}

// Sums of squares of deviations: the share of means that differ from the expected value by more than a bound.
Part weak_law_part(uint64_t seed) {
  constexpr int kRepeats = 2000;
  constexpr double kDistance = 0.1, kVariance = 1.0 / 12;
  FunctionCurve measured{.name = "measured, 2000 repeats", .style = CurveStyle::dots, .points = {}};
  FunctionCurve bound{.name = "bound of Chebyshev", .style = CurveStyle::dashed, .points = {}};
  RandomNumbers random(seed);
  for (int n = 1; n <= 256; n *= 2) {
    int outside = 0;
    for (int r = 0; r < kRepeats; ++r) {
      double sum = 0;
      for (int i = 0; i < n; ++i) sum += random.uniform();
      outside += std::abs(sum / n - 0.5) >= kDistance ? 1 : 0;
    }
    measured.points.push_back({static_cast<double>(n), outside / static_cast<double>(kRepeats)});
    bound.points.push_back({static_cast<double>(n), std::min(1.0, kVariance / (n * kDistance * kDistance))});
  }
  return chart_part({.title = "Probability of an error of 0.1 or more of the mean",
                     .x_label = "N",
                     .y_label = "probability",
                     .curves = {measured, bound},
                     .logarithmic_x = true},
                    560, 320);
}

Part walk_part(const std::string& name, const std::function<Point(RandomNumbers&)>& step, uint64_t seed) {
  constexpr int kSteps = 2000;
  std::vector<std::vector<Point>> walks;
  double extent = 1;
  for (uint64_t w = 0; w < 3; ++w) {
    RandomNumbers random(seed * 3 + w);
    std::vector<Point> walk{{0, 0}};
    for (int i = 0; i < kSteps; ++i) {
      const Point s = step(random);
      walk.push_back({walk.back().x + s.x, walk.back().y + s.y});
      extent = std::max({extent, std::abs(walk.back().x), std::abs(walk.back().y)});
    }
    walks.push_back(std::move(walk));
  }
  PlaneDrawing plane({.x = {-extent, extent}, .y = {-extent, extent}, .width = 300, .height = 300});
  for (size_t w = 0; w < walks.size(); ++w) plane.line(walks[w], ink(w), 1);
  plane.dot({0, 0}, kBlack, 4);
  return plane_part(name, plane);
}

}  // namespace

Figure figure_2_45() {
  return {
      .title = "A probability mass function",
      .note = "The number of pips of one die and of two dice.",
      .make = [](const MakeContext&) -> Result<Parts> {
        return Parts{mass_part("One die", 1, 6, [](int) { return 1.0 / 6; }), mass_part("Two dice", 2, 12, two_dice)};
      }};
}

Figure figure_2_46() {
  return {
      .title = "Cumulative distribution function of a discrete random variable",
      .note = "The number of pips of one die and of two dice.",
      .make = [](const MakeContext&) -> Result<Parts> {
        return Parts{step_part("One die", 1, 6, [](int) { return 1.0 / 6; }), step_part("Two dice", 2, 12, two_dice)};
      }};
}

Figure figure_2_47() {
  return {.title = "A probability density function",
          .note = "The standard normal distribution. Right, the probability of [-1, 1] as the area below the density.",
          .make = [](const MakeContext&) -> Result<Parts> {
            const auto density = [](double x) { return normal_density(x); };
            PlaneDrawing plane({.x = {-4, 4}, .y = {0, 0.45}, .width = 420, .height = 260});
            std::vector<Point> area = sampled(density, -1, 1);
            area.push_back({1, 0});
            area.push_back({-1, 0});
            plane.area(area, transparent(ink(1), 0.3));
            plane.line(sampled(density, -4, 4), ink(0), 2);
            return Parts{
                curves_part("Density", "x", "p", {curve_of("p", density, -4, 4)}),
                plane_part("Probability of [-1, 1]: " + metrics::short_number(normal_cdf(1) - normal_cdf(-1)), plane)};
          }};
}

Figure figure_2_48() {
  return {.title = "Densities of uniform distributions", .make = [](const MakeContext&) -> Result<Parts> {
            const auto uniform = [](double a, double b) {
              return [a, b](double x) { return x >= a && x <= b ? 1 / (b - a) : 0.0; };
            };
            return Parts{curves_part("On [0, 1]", "x", "p", {curve_of("1", uniform(0, 1), -1, 4)}),
                         curves_part("On [a, b] = [1, 3]", "x", "p", {curve_of("1 / (b - a)", uniform(1, 3), -1, 4)})};
          }};
}

Figure figure_2_49() {
  return {.title = "Cumulative distribution function of a continuous random variable",
          .make = [](const MakeContext&) -> Result<Parts> {
            return Parts{curves_part("Density", "x", "p",
                                     {curve_of(
                                         "p", [](double x) { return normal_density(x); }, -4, 4)}),
                         curves_part("Distribution function", "x", "F", {curve_of("F", normal_cdf, -4, 4)})};
          }};
}

Figure figure_2_50() {
  return {.title = "Uniform distribution on [a, b]",
          .note = "Here [a, b] is [1, 3].",
          .make = [](const MakeContext&) -> Result<Parts> {
            return Parts{curves_part("Density", "x", "p",
                                     {curve_of(
                                         "p", [](double x) { return x >= 1 && x <= 3 ? 0.5 : 0.0; }, 0, 4)}),
                         curves_part("Distribution function", "x", "F",
                                     {curve_of(
                                         "F", [](double x) { return std::clamp((x - 1) / 2, 0.0, 1.0); }, 0, 4)})};
          }};
}

Figure figure_2_51() {
  return {.title = "Important densities and distribution functions",
          .note = "Exponential, normal and power distributions.",
          .make = [](const MakeContext&) -> Result<Parts> {
            const auto power = [](double x) { return x >= 0 && x <= 1 ? 3 * x * x : 0.0; };
            return Parts{
                curves_part("Densities", "x", "p",
                            {curve_of(
                                 "exp(-x)", [](double x) { return x >= 0 ? std::exp(-x) : 0.0; }, -2, 4),
                             curve_of(
                                 "normal", [](double x) { return normal_density(x); }, -2, 4),
                             curve_of("3 x\u00b2", power, -2, 4)}),
                curves_part("Distribution functions", "x", "F",
                            {curve_of(
                                 "exponential", [](double x) { return x >= 0 ? 1 - std::exp(-x) : 0.0; }, -2, 4),
                             curve_of("normal", normal_cdf, -2, 4),
                             curve_of(
                                 "power", [](double x) { return std::pow(std::clamp(x, 0.0, 1.0), 3); }, -2, 4)})};
          }};
}

Figure figure_2_52() {
  return {.title = "A joint probability mass function",
          .note = "The smaller and the larger number of pips of two dice: 1/36 on the diagonal, 1/18 above it.",
          .make = [](const MakeContext&) -> Result<Parts> {
            PlaneDrawing plane({.x = {0.5, 6.5}, .y = {0.5, 6.5}, .width = 300, .height = 300});
            for (int x = 1; x <= 6; ++x)
              for (int y = x; y <= 6; ++y)
                plane.rectangle({x - 0.5, x + 0.5}, {y - 0.5, y + 0.5}, transparent(ink(0), x == y ? 0.3 : 0.6));
            plane.grid(6, 6, kLightGrey);
            return Parts{plane_part("Smaller number to the right, larger one upwards", plane)};
          }};
}

Figure figure_2_53() {
  return {.title = "Normal distributions with the same mean and different variances",
          .make = [](const MakeContext&) -> Result<Parts> {
            return Parts{curves_part("Standard deviation 1.5", "x", "p",
                                     {curve_of(
                                         "p", [](double x) { return normal_density(x, 1.5); }, -5, 5)}),
                         curves_part("Standard deviation 0.5", "x", "p",
                                     {curve_of(
                                         "p", [](double x) { return normal_density(x, 0.5); }, -5, 5)})};
          }};
}

Figure figure_2_54() {
  return {
      .title = "The factor 1/alpha - 1 of the variance of Russian roulette",
      .note =
          "Survival probabilities close to 0 give a large variance and those close to 1 a small one; the caption of "
          "the book states high values for both.",
      .make = [](const MakeContext&) -> Result<Parts> {
        const auto factor = [](double a) { return 1 / a - 1; };
        return Parts{curves_part("Close to 0", "alpha", "1/alpha - 1", {curve_of("1/alpha - 1", factor, 0.01, 0.2)}),
                     curves_part("Close to 1", "alpha", "1/alpha - 1", {curve_of("1/alpha - 1", factor, 0.8, 1)})};
      }};
}

Figure figure_2_56() {
  return {.title = "The inequality of Chebyshev",
          .note = "Probability that a number is k or more standard deviations away from its expected value.",
          .make = [](const MakeContext&) -> Result<Parts> {
            const double root3 = std::sqrt(3.0);
            return Parts{chart_part(
                {.title = "Bound and two distributions",
                 .x_label = "k",
                 .y_label = "probability",
                 .curves = {curve_of(
                                "bound 1 / k\u00b2", [](double k) { return std::min(1.0, 1 / (k * k)); }, 0.5, 4),
                            curve_of(
                                "normal", [](double k) { return 2 * normal_cdf(-k); }, 0.5, 4),
                            curve_of(
                                "uniform", [root3](double k) { return std::max(0.0, 1 - k / root3); }, 0.5, 4)}},
                560, 320)};
          }};
}

Figure figure_2_57() {
  return {.title = "The weak law of large numbers",
          .make = [](const MakeContext& context) -> Result<Parts> { return Parts{weak_law_part(context.seed)}; }};
}

Figure figure_2_58() {
  return {.title = "The strong law of large numbers", .make = [](const MakeContext& context) -> Result<Parts> {
            return Parts{running_mean_part("Mean of the pips of a die", 6, 1, 3.5, context.seed),
                         running_mean_part("Frequency of heads of a coin", 2, 0, 0.5, context.seed)};
          }};
}

Figure figure_2_59() {
  return {.title = "The normal distribution",
          .note = "68.27 %, 95.45 % and 99.73 % of all values lie within one, two and three standard deviations.",
          .make = [](const MakeContext&) -> Result<Parts> {
            const auto density = [](double x) { return normal_density(x); };
            PlaneDrawing plane({.x = {-4, 4}, .y = {0, 0.42}, .width = 460, .height = 280});
            for (const double k : {3.0, 2.0, 1.0}) {
              std::vector<Point> area = sampled(density, -k, k);
              area.push_back({k, 0});
              area.push_back({-k, 0});
              plane.area(area, transparent(ink(0), 0.22));
            }
            plane.line(sampled(density, -4, 4), ink(0), 2);
            return Parts{plane_part("Density with 1, 2 and 3 standard deviations", plane),
                         curves_part("Distribution function", "x", "F", {curve_of("F", normal_cdf, -4, 4)})};
          }};
}

Figure figure_2_60() {
  return {.title = "Random walks",
          .note = "Three walks of 2000 steps: on the lattice Z\u00b2, and with steps of a normal distribution.",
          .make = [](const MakeContext& context) -> Result<Parts> {
            const auto lattice = [](RandomNumbers& random) {
              constexpr std::array<Point, 4> kSteps{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
              return kSteps[static_cast<size_t>(4 * random.uniform())];
            };
            const auto normal = [](RandomNumbers& random) {
              const double r = std::sqrt(-2 * std::log(1 - random.uniform())),
                           a = 2 * std::numbers::pi * random.uniform();
              return Point{r * std::cos(a), r * std::sin(a)};
            };
            return Parts{walk_part("Lattice", lattice, context.seed), walk_part("Normal steps", normal, context.seed)};
          }};
}

Figure figure_A_8() {
  return {.title = "A first encounter with discrepancy",
          .note =
              "256 random points. The boxes have the same area, 0.25, and contain different numbers of points; 64 are "
              "expected.",
          .make = [](const MakeContext& context) -> Result<Parts> {
            RandomNumbers random(context.seed);
            std::vector<Point> points;
            for (int i = 0; i < 256; ++i) {
              const double x = random.uniform();
              points.push_back({x, random.uniform()});
            }
            Parts parts;
            for (const double width : {0.5, 0.3125, 0.8}) {
              const double height = 0.25 / width;
              PlaneDrawing plane;
              plane.rectangle({0, width}, {0, height}, transparent(ink(1), 0.25));
              int inside = 0;
              for (const Point& p : points) inside += p.x < width && p.y < height ? 1 : 0;
              plane.dots(points, ink(0), 1.8);
              parts.push_back(plane_part(std::to_string(inside) + " points in the box", plane));
            }
            return parts;
          }};
}

}  // namespace etendue::figures
