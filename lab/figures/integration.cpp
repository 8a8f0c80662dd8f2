// Figures of chapter 6: quadrature and Monte Carlo estimators.
#include <cmath>
#include <numbers>

#include "equations/quadrature.h"
#include "equations/random_numbers.h"
#include "figures/tools.h"
#include "metrics/log_axis.h"

namespace etendue::figures {
namespace {

constexpr double kPi64 = std::numbers::pi;

// An integrand with an oscillation that rules of few panels miss.
double wavy(double x) { return 0.55 + 0.25 * std::sin(5 * x) + 0.15 * x; }

// The part of the plane in which `wavy` is drawn.
PlaneDrawingSettings wavy_plane() { return {.x = {0, 2}, .y = {0, 1.2}, .width = 380, .height = 230}; }

// The parabola through three points at a, (a + b)/2 and b.
double parabola(double a, double b, double x) {
  const double t = (x - a) / (b - a), fa = wavy(a), fm = wavy(0.5 * (a + b)), fb = wavy(b);
  return fa * (1 - t) * (1 - 2 * t) + fm * 4 * t * (1 - t) + fb * t * (2 * t - 1);
}

void fill_below(PlaneDrawing& plane, const std::vector<Point>& curve, const Color& color) {
  std::vector<Point> area = curve;
  area.push_back({curve.back().x, 0});
  area.push_back({curve.front().x, 0});
  plane.area(area, color);
}

Part panel_rule(const std::string& name, bool simpson) {
  constexpr int kPanels = 4;
  PlaneDrawing plane(wavy_plane());
  for (int i = 0; i < kPanels; ++i) {
    const double a = 2.0 * i / kPanels, b = 2.0 * (i + 1) / kPanels;
    const auto curve = simpson ? sampled([&](double x) { return parabola(a, b, x); }, a, b, 40)
                               : std::vector<Point>{{a, wavy(a)}, {b, wavy(b)}};
    fill_below(plane, curve, transparent(ink(1), i % 2 == 0 ? 0.22 : 0.38));
  }
  plane.line(sampled(wavy, 0, 2), ink(0), 2);
  return plane_part(name, plane);
}

Part nodes_part(const std::string& name, const equations::QuadratureRule& rule) {
  PlaneDrawing plane(wavy_plane());
  plane.line(sampled(wavy, 0, 2), ink(0), 2);
  for (const double node : rule.nodes) {
    plane.line({{2 * node, 0}, {2 * node, wavy(2 * node)}}, kGrey, 1.2, true);
    plane.dot({2 * node, wavy(2 * node)}, ink(1), 4);
    plane.dot({2 * node, 0}, ink(1), 4);
  }
  return plane_part(name, plane);
}

// The running estimate over N for an integrand divided by its density.
struct RunningEstimate {
  const char* name;
  double (*ratio)(double u);  // f / p at the sample of a uniform number
};
std::vector<Point> running_means(const RunningEstimate& estimate, int count, equations::RandomNumbers& random) {
  std::vector<Point> means;
  double sum = 0;
  for (int n = 1; n <= count; ++n) {
    sum += estimate.ratio(random.uniform());
    means.push_back({static_cast<double>(n), sum / n});
  }
  return means;
}

Part density_chart(const char* title, double (*f)(double), double (*p)(double)) {
  return curves_part(title, "x", "",
                     {{.name = "f", .points = sampled(f, 0, 1)},
                      {.name = "density p", .style = CurveStyle::dashed, .points = sampled(p, 0, 1)}},
                     330, 260);
}

// A function of high frequency with a narrow support.
double narrow_peaks(double x) {
  const double envelope = std::exp(-60 * (x - 0.68) * (x - 0.68));
  return envelope * (0.6 + 0.4 * std::cos(70 * x));
}

Part sampled_function(const std::string& name, double (*f)(double), const std::vector<double>& samples, int cells = 1) {
  PlaneDrawing plane({.x = {0, 1}, .y = {0, 1.1}, .width = 380, .height = 200});
  plane.grid(cells, 1, kGrey);
  plane.line(sampled(f, 0, 1, 500), ink(0), 1.6);
  for (const double x : samples) {
    plane.line({{x, 0}, {x, f(x)}}, transparent(ink(1), 0.5));
    plane.dot({x, f(x)}, ink(1), 3);
    plane.dot({x, 0.012}, kBlack, 2);
  }
  return plane_part(name, plane);
}

}  // namespace

Figure figure_6_1() {
  return {.title = "Trapezoid and Simpson's rule on four panels", .make = [](const MakeContext&) -> Result<Parts> {
            return Parts{panel_rule("Trapezoid rule", false), panel_rule("Simpson's rule", true)};
          }};
}

Figure figure_6_2() {
  return {.title = "Equidistant nodes and those of Gauss and Legendre",
          .make = [](const MakeContext&) -> Result<Parts> {
            return Parts{nodes_part("Equidistant nodes (Newton-Cotes)", equations::trapezoid_rule(4)),
                         nodes_part("Gauss-Legendre nodes", equations::gauss_legendre(5))};
          }};
}

Figure figure_6_3() {
  return {.title = "Convergence of tensor products over the dimension",
          .note =
              "Errors proportional to N^(-2/s). Halving the error takes 4, 16, 256 and 65536 times the evaluations "
              "for s = 4, 8, 16 and 32; the caption of the book states 4, 16 and 32 for the last three.",
          .make = [](const MakeContext&) -> Result<Parts> {
            FunctionChart chart{.title = "Error of an interpolatory rule, r = 2",
                                .x_label = "evaluations N",
                                .y_label = "error relative to N = 1",
                                .curves = {},
                                .logarithmic_x = true,
                                .logarithmic_y = true};
            for (const int s : {4, 8, 16, 32}) {
              FunctionCurve curve{.name = "s = " + std::to_string(s), .points = {}};
              for (int k = 0; k <= 48; ++k) {
                const double n = std::pow(10.0, k / 8.0);
                curve.points.push_back({n, std::pow(n, -2.0 / s)});
              }
              chart.curves.push_back(std::move(curve));
            }
            return Parts{chart_part(chart, 560, 340)};
          }};
}

Figure figure_6_4() {
  return {.title = "The area of the unit disk by a regular grid", .make = [](const MakeContext&) -> Result<Parts> {
            Parts parts;
            for (const int n : {10, 20, 40}) {
              PlaneDrawing plane({.x = {-1, 1}, .y = {-1, 1}});
              int inside = 0;
              for (int i = 0; i < n * n; ++i) {
                // NOLINTNEXTLINE(bugprone-integer-division)
                const Point p{(i % n + 0.5) * 2 / n - 1, (i / n + 0.5) * 2 / n - 1};
                const bool counts = p.x * p.x + p.y * p.y < 1;
                inside += counts ? 1 : 0;
                plane.dot(p, counts ? ink(0) : kLightGrey, 60.0 / n);
              }
              plane.circle({0, 0}, 1, kBlack);
              parts.push_back(plane_part(std::to_string(n * n) + " points: area " +
                                             metrics::short_number(4.0 * inside / (n * n)) + " instead of 3.1416",
                                         plane));
            }
            return parts;
          }};
}

Figure figure_6_5() {
  return {
      .title = "A secondary estimator of the integral of exp(-x\u00b2) over [-1, 1]",
      .note =
          "The areas of the boxes are single estimates; their mean is the estimate. The integral is 1.4936. The "
          "caption of the book states the domain [-1, 1]\u00b2.",
      .columns = 3,
      .make = [](const MakeContext& context) -> Result<Parts> {
        const auto f = [](double x) { return std::exp(-x * x); };
        equations::RandomNumbers random(context.seed);
        Parts parts;
        double sum = 0;
        for (int i = 1; i <= 6; ++i) {
          const double x = 2 * random.uniform() - 1;
          sum += 2 * f(x);
          PlaneDrawing plane({.x = {-1, 1}, .y = {0, 1.1}, .width = 220, .height = 150});
          plane.rectangle({-1, 1}, {0, f(x)}, transparent(ink(static_cast<size_t>(i)), 0.3));
          plane.line(sampled(f, -1, 1), ink(0), 2);
          plane.dot({x, f(x)}, kBlack, 3.5);
          parts.push_back(plane_part("X = " + metrics::short_number(x) + ", area " + metrics::short_number(2 * f(x)) +
                                         ", mean " + metrics::short_number(sum / i),
                                     plane));
        }
        return parts;
      }};
}

Figure figure_6_6() {
  return {
      .title = "Estimators of the integral of cos x over [0, pi/2] with different densities",
      .note =
          "The integral is 1. With p = 8 x / pi\u00b2 the variance is infinite: close to 0 the density vanishes and "
          "the integrand does not, so that rare samples move the mean far. Three runs for each density.",
      .columns = 2,
      .make = [](const MakeContext& context) -> Result<Parts> {
        struct Row {
          const char* density_name;
          double (*density)(double);
          RunningEstimate estimate;
        };
        const Row rows[] = {
            {"p = 8 x / pi\u00b2",
             [](double x) { return 8 * x / (kPi64 * kPi64); },
             {"running mean, p = 8 x / pi\u00b2",
              [](double u) {
                const double x = 0.5 * kPi64 * std::sqrt(u + 0x1p-54);
                return std::cos(x) * kPi64 * kPi64 / (8 * x);
              }}},
            {"p = 2 / pi",
             [](double) { return 2 / kPi64; },
             {"running mean, p = 2 / pi", [](double u) { return 0.5 * kPi64 * std::cos(0.5 * kPi64 * u); }}},
            {"p = cos x", [](double x) { return std::cos(x); }, {"running mean, p = cos x", [](double) {
                                                                   return 1.0;
                                                                 }}}};
        Parts parts;
        equations::RandomNumbers random(context.seed);
        for (const Row& row : rows) {
          parts.push_back(curves_part(
              row.density_name, "x", "",
              {{.name = "cos x", .points = sampled([](double x) { return std::cos(x); }, 0, 0.5 * kPi64)},
               {.name = "density", .style = CurveStyle::dashed, .points = sampled(row.density, 0, 0.5 * kPi64)}},
              360, 220));
          std::vector<FunctionCurve> runs;
          for (int run = 1; run <= 3; ++run)
            runs.push_back({.name = "run " + std::to_string(run), .points = running_means(row.estimate, 500, random)});
          parts.push_back(curves_part(row.estimate.name, "samples", "", std::move(runs), 360, 220));
        }
        return parts;
      }};
}

Figure figure_6_7() {
  return {.title = "Variance of the mean of squared uniform numbers",
          .note = "The variance is 4 / (45 N); the book states 8 / (9 N).",
          .make = [](const MakeContext& context) -> Result<Parts> {
            equations::RandomNumbers random(context.seed);
            FunctionCurve measured{.name = "measured, 1000 repeats", .style = CurveStyle::dots, .points = {}};
            FunctionCurve theory{.name = "4 / (45 N)", .style = CurveStyle::dashed, .points = {}};
            for (int n = 1; n <= 1024; n *= 2) {
              double squares = 0;
              for (int repeat = 0; repeat < 1000; ++repeat) {
                double sum = 0;
                for (int i = 0; i < n; ++i) sum += std::pow(random.uniform(), 2);
                squares += std::pow(sum / n - 1.0 / 3, 2);
              }
              measured.points.push_back({static_cast<double>(n), squares / 1000});
              theory.points.push_back({static_cast<double>(n), 4 / (45.0 * n)});
            }
            return Parts{chart_part({.title = "Variance of the mean of N squared uniform numbers",
                                     .x_label = "N",
                                     .y_label = "variance",
                                     .curves = {measured, theory},
                                     .logarithmic_x = true,
                                     .logarithmic_y = true},
                                    560, 340)};
          }};
}

Figure figure_6_24() {
  return {.title = "Uniform and importance samples of a function with narrow peaks",
          .make = [](const MakeContext& context) -> Result<Parts> {
            equations::RandomNumbers random(context.seed);
            std::vector<double> uniform, important;
            for (int i = 0; i < 24; ++i) uniform.push_back(random.uniform());
            while (important.size() < 24) {  // rejection
              const double x = random.uniform();
              if (random.uniform() < narrow_peaks(x)) important.push_back(x);
            }
            return Parts{sampled_function("Uniform samples", narrow_peaks, uniform),
                         sampled_function("Density proportional to the function", narrow_peaks, important)};
          }};
}

Figure figure_6_25() {
  return {.title = "Densities for importance sampling of exp(-x)",
          .note =
              "N times the variance is infinite, 0.03276 and 0.00364, from left to right. The left density vanishes "
              "at 1, where the function does not.",
          .make = [](const MakeContext&) -> Result<Parts> {
            const auto f = [](double x) { return std::exp(-x); };
            return Parts{density_chart("p = 2 (1 - x)", f, [](double x) { return 2 * (1 - x); }),
                         density_chart("p = 1", f, [](double) { return 1.0; }),
                         density_chart("p = (4/3) (1 - x/2)", f, [](double x) { return 4.0 / 3 * (1 - x / 2); })};
          }};
}

Figure figure_6_26() {
  return {.title = "The control variate 1 + x of exp(x)",
          .note = "N times the variance falls from 0.2420 to 0.0437.",
          .make = [](const MakeContext&) -> Result<Parts> {
            return Parts{curves_part("exp(x) and its control variate", "x", "",
                                     {{.name = "exp(x)", .points = sampled([](double x) { return std::exp(x); }, 0, 1)},
                                      {.name = "1 + x", .points = sampled([](double x) { return 1 + x; }, 0, 1)},
                                      {.name = "difference",
                                       .style = CurveStyle::dashed,
                                       .points = sampled([](double x) { return std::exp(x) - 1 - x; }, 0, 1)}},
                                     520, 320)};
          }};
}

Figure figure_6_27() {
  return {.title = "Clumped and stratified samples", .make = [](const MakeContext& context) -> Result<Parts> {
            const auto f = [](double x) { return 0.5 + 0.3 * std::sin(40 * x) + 0.15 * std::sin(91 * x); };
            equations::RandomNumbers random(context.seed + 1);
            std::vector<double> clumped, stratified;
            for (int i = 0; i < 16; ++i) {
              clumped.push_back(random.uniform());
              stratified.push_back((i + random.uniform()) / 16);
            }
            return Parts{sampled_function("16 independent samples", f, clumped, 4),
                         sampled_function("One sample in each of 16 intervals", f, stratified, 4)};
          }};
}

}  // namespace etendue::figures
