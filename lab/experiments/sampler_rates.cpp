// Convergence rates of the samplers of the renderer for integrands over the unit square
// [Lang, sec. 6.5.7, 7.1-7.3; Owen 1997]
//
// The root mean square error over independent randomisations falls as N^-r (log N)^q. The rates r that theory has, with q
// = 1/2 where it is marked by *:
//
//                       random   latin-hypercube   stratified   regular-grid   scrambled nets
//   x + y                  1/2               3/2            1            1/2              3/2
//   x y                    1/2               1/2            1            1/2             3/2*
//   box                    1/2               1/2          3/4            1/2               1*
//   half-plane             1/2               1/2          3/4            1/2              3/4
//   disc                   1/2               1/2          3/4            3/4              3/4
//
// Scrambled nets are sobol, pmj02, blue-noise, niederreiter, hammersley with Owen scrambling. An edge of length 1 crosses about N^(1/2)
// cells of a stratification, each of which adds a variance of N^-2: the error is N^(-3/4). A grid with a random offset
// samples each variable at N^(1/2) places only, and all functions but the disc have a jump between opposite sides of the
// square, which is parallel to the grid. The points of Latin hypercubes are stratified in each variable, so that only sums
// of functions of one variable gain.
//
// Samplers whose sets have a fixed size take sets of N points. N is a power of 4. Samplers without a theory in the table
// are drawn and have a slope in the table of results.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "equations/random_numbers.h"
#include "experiments/error_curves.h"
#include "experiments/uniform_points.h"

namespace etendue::experiments {

enum class SquareIntegrand { sum, product, box, half_plane, disc };

}  // namespace etendue::experiments

template <>
struct etendue::Options<etendue::experiments::SquareIntegrand> {
  static constexpr std::array<etendue::Option, 5> kOptions{{{"sum", "x + y"},
                                                            {"product", "x y"},
                                                            {"box", "Box with a random corner"},
                                                            {"half-plane", "Half-plane with a random edge"},
                                                            {"disc", "Disc with a random centre"}}};
};

namespace etendue::experiments {
namespace {

using equations::RandomNumbers;

constexpr Repeats kRateRepeats{.groups = 8, .per_group = 32};
constexpr double kRateTolerance = 0.05;
constexpr int kLeastLog4 = 2;

struct PlaneFunction {
  std::function<double(double, double)> value;
  double integral = 0;
};

// The area of the part of the unit square with a x + b y < c, for a, b > 0.
double area_below(double a, double b, double c) {
  const auto triangle = [&](double d) { return d > 0 ? d * d / (2 * a * b) : 0; };
  return triangle(c) - triangle(c - a) - triangle(c - b) + triangle(c - a - b);
}

// Random positions keep a distance from the border of the square and, for lines, from the directions of the axes.
PlaneFunction make_function(SquareIntegrand kind, RandomNumbers& random) {
  const double u = 0.2 + 0.6 * random.uniform(), v = 0.2 + 0.6 * random.uniform();
  switch (kind) {
    case SquareIntegrand::sum:
      return {[](double x, double y) { return x + y; }, 1};
    case SquareIntegrand::product:
      return {[](double x, double y) { return x * y; }, 0.25};
    case SquareIntegrand::box:
      return {[u, v](double x, double y) { return x < u && y < v ? 1.0 : 0.0; }, u * v};
    case SquareIntegrand::half_plane: {
      const double angle = u * std::numbers::pi / 2, a = std::cos(angle), b = std::sin(angle), c = v * (a + b);
      return {[a, b, c](double x, double y) { return a * x + b * y < c ? 1.0 : 0.0; }, area_below(a, b, c)};
    }
    case SquareIntegrand::disc:
      break;
  }
  const double radius = 0.1 + 0.1 * random.uniform(), square = radius * radius;
  return {[u, v, square](double x, double y) { return (x - u) * (x - u) + (y - v) * (y - v) < square ? 1.0 : 0.0; },
          square * std::numbers::pi};
}

// An error of N^-power (log N)^log_power.
struct Rate {
  double power, log_power = 0;
};

// The rates of the table above.
std::optional<Rate> theoretical_rate(std::string_view sampler, SquareIntegrand kind) {
  struct Row {
    std::string_view sampler;
    std::array<Rate, 5> rates;  // in the order of SquareIntegrand
  };
  constexpr std::array<Rate, 5> kNet{{{1.5}, {1.5, 0.5}, {1, 0.5}, {0.75}, {0.75}}};
  constexpr Row kRows[] = {{"random", {{{0.5}, {0.5}, {0.5}, {0.5}, {0.5}}}},
                           {"latin-hypercube", {{{1.5}, {0.5}, {0.5}, {0.5}, {0.5}}}},
                           {"stratified", {{{1}, {1}, {0.75}, {0.75}, {0.75}}}},
                           {"regular-grid", {{{0.5}, {0.5}, {0.5}, {0.5}, {0.75}}}},
                           {"sobol", kNet},
                           {"pmj02", kNet},
                           {"blue-noise", kNet},
                           {"niederreiter", kNet},
                           {"hammersley", kNet}};
  const auto row = std::ranges::find(kRows, sampler, &Row::sampler);
  if (row == std::end(kRows)) return {};
  return row->rates[static_cast<size_t>(kind)];
}

// The settings with which a sampler of sets of a fixed size makes sets of N = 4^k points.
std::vector<Setting> settings_for(const SamplerInfo& sampler, int log4) {
  const std::pair<const char*, int64_t> sizes[] = {
      {"side", int64_t{1} << log4}, {"samples", int64_t{1} << 2 * log4}, {"log2-size", 2 * log4}};
  std::vector<Setting> settings;
  for (const auto& [name, value] : sizes)
    if (find_parameter(sampler.parameters, name)) settings.push_back({name, value});
  return settings;
}

struct SamplerRates {
  static constexpr ExperimentDescription kDescription{
      .name = "sampler-rates",
      .label = "Convergence rates of samplers",
      .summary = "The error of every sampler over the number of points, with the rates of theory",
      .source = "[Lang, sec. 6.5.7, 7.1-7.3]; Owen 1997, Scrambled net variance for integrals of smooth functions"};

  Choice<SquareIntegrand> integrand{"integrand", "Integrand", SquareIntegrand::product, "The integrated function"};
  Number<int> log4_points{"log4-points",
                          "Points, power of 4",
                          6,
                          {4, 6},
                          "The largest number of points is 4 to this power. Raising it makes slopes more exact"};
  auto parameters() { return std::tie(integrand, log4_points); }

  Result<ExperimentResult> run(const RunContext& context) const {
    ExperimentResult result;
    result.table.columns = {"sampler", "points", "RMS error", "slope", "standard error", "slope of theory"};
    ErrorChart chart{.title = Options<SquareIntegrand>::kOptions[static_cast<size_t>(integrand.value)].label,
                     .work = "points",
                     .curves = {}};
    const auto& samplers = sampler_infos();
    for (size_t i = 0; i < samplers.size(); ++i) {
      RunContext part = context;
      part.progress = [&](double share) {
        return context.proceed((static_cast<double>(i) + share) / static_cast<double>(samplers.size()));
      };
      auto curves = curves_of(samplers[i], part);
      if (!curves) return curves.error();
      add_result(samplers[i], *curves, result);
      chart.curves.push_back(std::move(*curves));
    }
    result.charts.emplace_back(std::move(chart));
    return result;
  }

 private:
  std::vector<double> work() const {
    std::vector<double> numbers;
    for (int k = kLeastLog4; k <= log4_points; ++k) numbers.push_back(std::ldexp(1.0, 2 * k));
    return numbers;
  }

  Result<metrics::MethodCurves> curves_of(const SamplerInfo& sampler, const RunContext& context) const {
    const std::vector<double> counts = work();
    std::vector<UniformPoints> sets;
    for (int k = kLeastLog4; k <= log4_points; ++k)
      sets.emplace_back(sampler.name, uint32_t{1} << 2 * k, settings_for(sampler, k));
    const auto errors = [&](int repeat, std::span<double> out) {
      RandomNumbers random(mix_bits(context.seed) + static_cast<uint64_t>(repeat));
      const PlaneFunction f = make_function(integrand, random);
      for (size_t k = 0; k < sets.size(); ++k) {
        const auto seed = hash_combine(static_cast<uint32_t>(context.seed), static_cast<uint32_t>(repeat));
        double sum = 0;
        std::array<double, 2> x{};
        for (uint32_t i = 0; i < static_cast<uint32_t>(counts[k]); ++i) {
          sets[k].point(seed, i, x);
          sum += f.value(x[0], x[1]);
        }
        out[k] = sum / counts[k] - f.integral;
      }
    };
    return rms_error_curves(sampler.name, counts, kRateRepeats, errors, context);
  }

  // The slope that the errors of theory have at the same numbers of points.
  double slope_of_theory(const Rate& rate) const {
    const std::vector<double> counts = work();
    std::vector<double> errors;
    for (const double n : counts) errors.push_back(std::pow(n, -rate.power) * std::pow(std::log2(n), rate.log_power));
    return slope(error_curve("theory", counts, errors)).value;
  }

  void add_result(const SamplerInfo& sampler, const metrics::MethodCurves& curves, ExperimentResult& result) const {
    const metrics::Estimate measured = slope(curves);
    const auto end = metrics::curve_end(curves, metrics::Abscissa::samples, film::ErrorMeasure::rmse);
    const auto rate = theoretical_rate(sampler.name, integrand);
    const double expected = rate ? slope_of_theory(*rate) : NAN;
    result.table.rows.push_back({sampler.name, end.spp, end.point ? end.point->median : 0.0, measured.value,
                                 measured.standard_error, expected});
    if (rate) result.checks.push_back({sampler.name + ": slope", measured.value, expected, kRateTolerance});
  }
};

}  // namespace

Experiment sampler_rates_experiment() { return make_experiment<SamplerRates>(); }

}  // namespace etendue::experiments
