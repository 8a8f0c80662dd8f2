// The experiments of the laboratory: every check of every experiment holds.
//
// The tolerances of the checks are 4.5 standard errors, three for slopes. With the fixed seed there is no false alarm
// unless the estimates change.
#include "experiments/experiment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "base/vec.h"
#include "experiments/densities.h"
#include "experiments/experiment_output.h"
#include "experiments/moments.h"
#include "experiments/test_integrands.h"

namespace etendue::experiments {
namespace {

ExperimentResult run(const std::string& name, const std::vector<std::pair<std::string, std::string>>& settings = {}) {
  const Experiment* experiment = find_experiment(name);
  std::vector<Setting> values;
  for (const auto& [parameter, text] : settings)
    values.push_back({parameter, *parse_value(*find_parameter(experiment->parameters, parameter), text)});
  auto result = experiment->run(values, {});
  EXPECT_TRUE(result) << name << ": " << (result ? "" : result.error().message);
  return result ? *result : ExperimentResult{};
}

void expect_checks(const ExperimentResult& result, const std::string& name) {
  for (const Check& c : result.checks)
    EXPECT_TRUE(c.holds()) << name << ", " << c.name << ": " << c.measured << ", expected " << c.expected << " within "
                           << c.tolerance;
}

TEST(Experiments, AllChecksHoldWithDefaultParameters) {
  for (const Experiment& e : experiments()) {
    const ExperimentResult result = run(e.description.name);
    EXPECT_FALSE(result.checks.empty()) << e.description.name;
    EXPECT_FALSE(result.charts.empty()) << e.description.name;
    EXPECT_FALSE(result.table.rows.empty()) << e.description.name;
    expect_checks(result, e.description.name);
  }
}

TEST(Experiments, OutputsHaveAllPoints) {
  const ExperimentResult result = run("lebesgue-sums", {{"parts", "8"}});
  const auto json = to_json(result);
  EXPECT_EQ(json["charts"][0]["curves"].size(), 3u);
  EXPECT_EQ(json["charts"][0]["curves"][0]["points"].size(), 3u);
  EXPECT_EQ(json["table"]["rows"].size(), 3u);
  const std::string csv = to_csv(result);
  EXPECT_EQ(std::ranges::count(csv, '\n'), 10);
  EXPECT_NE(csv.find("\"upper Riemann sum\",0,8,"), std::string::npos) << csv;
  EXPECT_NE(metrics::to_svg(drawing_of(result)).find("upper Riemann sum"), std::string::npos);
}

TEST(Experiments, ACheckOutsideOfItsToleranceDoesNotHold) {
  EXPECT_FALSE((Check{.name = "", .measured = 1.1, .expected = 1, .tolerance = 0.05}).holds());
  EXPECT_FALSE((Check{.name = "", .measured = NAN, .expected = 1, .tolerance = 0.05}).holds());
}

TEST(Experiments, RunsCanBeInterrupted) {
  for (const Experiment& e : experiments()) {
    if (e.description.name == std::string("lebesgue-sums")) continue;  // takes no time
    const auto result = e.run({}, {.progress = [](double) { return false; }});
    ASSERT_FALSE(result) << e.description.name;
    EXPECT_EQ(result.error().fault, Fault::interrupted);
  }
}

// Means and variances of the first and the second coordinate. With a million samples and bounds of five standard errors,
// the false-alarm rate of all comparisons is below 2e-5.
TEST(SampledDensities, MomentsAreThoseOfTheory) {
  constexpr int kSamples = 1'000'000;
  struct Case {
    const char* name;
    SampledDensity density;
    SampledPoint mean, variance;
  };
  const double tail = std::exp(-5.0) / (1 - std::exp(-5.0));
  for (const Case& c : {Case{"3 x^2", power_density(), {0.75, 0}, {3.0 / 80, 0}},
                        Case{"exponential", exponential_density(), {0.2 - tail, 0}, {0.04 - tail * (1 + tail), 0}},
                        Case{"semicircle", semicircle_density(), {0.5, 0}, {1.0 / 16, 0}},
                        Case{"product", product_density(), {2.0 / 3, 0.75}, {1.0 / 18, 3.0 / 80}},
                        Case{"disk", disk_density(), {0.5, 0.5}, {1.0 / 16, 1.0 / 16}}})
    for (const auto* make : {&c.density.inversion, &c.density.transformation}) {
      if (!*make) continue;
      equations::RandomNumbers random(7);
      std::array<Moments, 2> moments, squares;
      for (int i = 0; i < kSamples; ++i) {
        const SampledPoint x = (*make)(random);
        for (size_t k = 0; k < 2; ++k) {
          moments[k].add(x[k]);
          squares[k].add(sqr(x[k] - c.mean[k]));
        }
      }
      for (size_t k = 0; k < static_cast<size_t>(c.density.dimension); ++k) {
        EXPECT_NEAR(moments[k].mean(), c.mean[k], 5 * moments[k].mean_error()) << c.name;
        EXPECT_NEAR(squares[k].mean(), c.variance[k], 5 * squares[k].mean_error()) << c.name;
      }
    }
}

// Area of the unit disk and mass of 3 x^2 by rejection: acceptance pi/4 and 1/3.
TEST(SampledDensities, BoundsAreThoseOfTheAcceptanceRates) {
  EXPECT_DOUBLE_EQ(1 / power_density().bound, 1.0 / 3);
  EXPECT_DOUBLE_EQ(1 / semicircle_density().bound, std::numbers::pi / 4);
  EXPECT_DOUBLE_EQ(1 / disk_density().bound, std::numbers::pi / 4);
}

TEST(Quadrature, SlopesAreThoseOfTheory) {
  for (const char* dimension : {"1", "2"}) expect_checks(run("quadrature", {{"dimension", dimension}}), dimension);
  for (const char* integrand : {"kink", "box"}) {
    const auto result = run("quadrature", {{"dimension", "1"}, {"integrand", integrand}});
    EXPECT_EQ(result.checks.size(), 5u);
    expect_checks(result, integrand);
  }
  // Tensor products in three dimensions with 16 panels per axis and more.
  const auto cube = run("quadrature", {{"dimension", "3"}, {"evaluations", "300000"}});
  EXPECT_EQ(cube.checks.size(), 5u);
  expect_checks(cube, "3");
}

// Forty-five slopes within 0.05 of theory.
TEST(SamplerRates, SlopesAreThoseOfTheory) {
  for (const char* integrand : {"sum", "product", "box", "half-plane", "disc"}) {
    const auto result = run("sampler-rates", {{"integrand", integrand}});
    EXPECT_EQ(result.checks.size(), 9u);
    expect_checks(result, integrand);
  }
}

TEST(Quadrature, UndefinedIntegrandIsAnError) {
  const Experiment* experiment = find_experiment("quadrature");
  const auto result = experiment->run({{"integrand", std::string("sinc")}}, {});
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find("trapezoid: the integrand is not finite at x = (0, 0)"), std::string::npos)
      << result.error().message;
}

TEST(Quadrature, VolumesOfUnitBalls) {
  const std::pair<int, double> volumes[] = {{2, 3.141592653589793},
                                            {3, 4.1887902047863905},
                                            {5, 5.263789013914325},
                                            {10, 2.550164039877345},
                                            {20, 0.02580689139001405}};
  for (const auto& [dimension, volume] : volumes)
    EXPECT_NEAR(ball_volume(dimension), volume, 1e-13 * volume) << dimension;
  // Random points find the ball in five dimensions.
  const auto result = run("quadrature", {{"dimension", "5"}, {"integrand", "ball"}, {"evaluations", "4096"}});
  expect_checks(result, "ball");
}

TEST(Quadrature, ManyDimensionsLeaveOutTensorProducts) {
  const auto result = run("quadrature", {{"dimension", "64"}, {"evaluations", "64"}});
  EXPECT_EQ(result.notes.size(), 4u);
  EXPECT_EQ(std::get<ErrorChart>(result.charts[0]).curves.size(), 2u);
}

TEST(Sampling, AllMethodsOfAllDensitiesPassTheChiSquareTest) {
  const Experiment* experiment = find_experiment("sampling");
  int run_count = 0;
  for (const auto& density : find_parameter(experiment->parameters, "density")->options)
    for (const auto& method : find_parameter(experiment->parameters, "method")->options) {
      const auto result = experiment->run({{"density", density}, {"method", method}}, {});
      if (!result) {
        EXPECT_NE(result.error().message.find("use rejection or metropolis"), std::string::npos);
        continue;
      }
      ++run_count;
      expect_checks(*result, density + ", " + method);
    }
  EXPECT_EQ(run_count, 25);
}

TEST(Sampling, TheChiSquareTestRejectsAChainThatDoesNotMix) {
  const auto result =
      run("sampling", {{"density", "peaks"}, {"method", "metropolis"}, {"step", "0.01"}, {"samples", "20000"}});
  EXPECT_FALSE(result.checks[0].holds());
  EXPECT_TRUE(result.checks[1].holds()) << "the acceptance rate does not show it";
}

TEST(Sampling, PublishesHistograms) {
  int published = 0;
  const RunContext context{.seed = 0, .progress = {}, .publish = [&](const ExperimentResult& r) {
                             ++published;
                             EXPECT_EQ(r.charts.size(), 1u);
                           }};
  ASSERT_TRUE(find_experiment("sampling")->run({{"samples", int64_t{10000}}}, context));
  EXPECT_EQ(published, 32);
}

TEST(Markov, ChainsHaveTheirClosedForms) {
  for (const char* chain : {"die", "coin", "photon", "mirror", "grammar", "ring"})
    expect_checks(run("markov", {{"chain", chain}}), chain);
}

TEST(Markov, PeriodicAndDecomposedChainsAreReported) {
  const auto periodic = run("markov", {{"chain", "swap"}});
  ASSERT_EQ(periodic.notes.size(), 1u);
  EXPECT_NE(periodic.notes[0].find("periodic"), std::string::npos);
  const auto decomposed = find_experiment("markov")->run({{"chain", std::string("stay")}}, {});
  ASSERT_FALSE(decomposed);
  EXPECT_NE(decomposed.error().message.find("2 independent stationary distributions"), std::string::npos);
}

TEST(Fredholm, OrdersAreThoseOfTheory) {
  for (const char* equation : {"cosine", "separable"}) {
    const auto result = run("fredholm", {{"equation", equation}});
    EXPECT_GE(result.checks.size(), 5u);
    expect_checks(result, equation);
  }
}

// A shadow edge inside an element reduces the order of every basis.
TEST(RadiosityElements, OrdersAreThoseOfTheory) {
  for (const char* light : {"smooth", "shadow-edge"}) {
    const auto result = run("radiosity-elements", {{"light", light}});
    EXPECT_EQ(result.checks.size(), 6u);
    expect_checks(result, light);
  }
}

TEST(Iterations, DivergenceIsDetectedAndReported) {
  const auto result = run("iterations", {{"equation", "logarithmic"}});
  expect_checks(result, "logarithmic");
  EXPECT_EQ(std::get<std::string>(result.table.rows[0][4]), "diverges");
  EXPECT_EQ(std::get<std::string>(result.table.rows[2][4]), "converged");
  EXPECT_NE(result.notes[0].find("The Neumann series diverges"), std::string::npos);
  for (const char* lambda : {"0.9", "1.5"})
    expect_checks(run("iterations", {{"equation", "constant"}, {"lambda", lambda}, {"steps", "400"}}), lambda);
}

TEST(RandomWalks, DivergentEquationsAreRefused) {
  for (const auto& [equation, lambda] : {std::pair("logarithmic", 0.5), std::pair("constant", 1.0)}) {
    const auto result =
        find_experiment("random-walks")->run({{"equation", std::string(equation)}, {"lambda", lambda}}, {});
    ASSERT_FALSE(result) << equation;
    EXPECT_NE(result.error().message.find("the Neumann series diverges"), std::string::npos) << result.error().message;
  }
}

// For the constant kernel lambda and g = 1 the variances are
//   collision   (1 + 2 lambda / (1 - lambda)) / (1 - lambda^2 / alpha) - 1 / (1 - lambda)^2
//   absorption  1 / ((1 - alpha)(1 - lambda^2 / alpha)) - 1 / (1 - lambda)^2
TEST(RandomWalks, VariancesOfTheConstantKernelHaveTheClosedForm) {
  struct Row {
    const char *lambda, *alpha;
    double collision, absorption;
  };
  for (const Row& row : {Row{"0.5", "0.3", 14, 4.571429}, Row{"0.5", "0.5", 2, 0},
                         Row{"0.5", "0.7", 0.6666667, 1.185185}, Row{"0.5", "0.9", 0.1538462, 9.846154},
                         Row{"0.8", "0.9", 6.153846, 9.615385}, Row{"0.9", "0.95", 28.92857, 35.71429}}) {
    const auto result = run(
        "random-walks", {{"equation", "constant"}, {"lambda", row.lambda}, {"alpha", row.alpha}, {"paths", "1024"}});
    // Single-precision parameters limit the accuracy.
    EXPECT_NEAR(std::get<double>(result.table.rows[0][3]), row.collision, 2e-5 * (1 + row.collision)) << row.lambda;
    EXPECT_NEAR(std::get<double>(result.table.rows[1][3]), row.absorption, 2e-5 * (1 + row.absorption)) << row.lambda;
  }
}

TEST(RandomWalks, InfiniteVarianceIsReported) {
  const auto result =
      run("random-walks", {{"equation", "constant"}, {"lambda", "0.8"}, {"alpha", "0.5"}, {"paths", "256"}});
  EXPECT_EQ(std::get<std::string>(result.table.rows[0][3]), "infinite");
  ASSERT_EQ(result.notes.size(), 1u);
  EXPECT_NE(result.notes[0].find("infinite"), std::string::npos);
}

TEST(RandomWalks, AllEquationsHaveTheirVariances) {
  for (const char* equation : {"cosine", "separable", "constant"})
    expect_checks(run("random-walks", {{"equation", equation}}), equation);
}

TEST(LinearWalks, MeansAreTheTermsOfTheSeries) {
  const std::pair<size_t, double> sums[] = {{0, 1},      {1, 1.5},     {2, 1.77},      {3, 1.915},
                                            {4, 1.9929}, {5, 2.03475}, {8, 2.07580041}};
  const auto result = run("linear-walks");
  expect_checks(result, "two");
  for (const auto& [steps, sum] : sums) EXPECT_NEAR(std::get<double>(result.table.rows[steps][3]), sum, 1e-8) << steps;
  EXPECT_NEAR(std::get<double>(result.table.rows[8][3]) - std::get<double>(result.table.rows[8][4]), 25.0 / 12, 1e-12);
  for (const char* reflectance : {"0", "0.5", "0.75"}) {
    const auto furnace =
        run("linear-walks", {{"system", "furnace"}, {"reflectance", reflectance}, {"length", "200"}, {"paths", "256"}});
    expect_checks(furnace, reflectance);
    EXPECT_NEAR(std::get<double>(furnace.table.rows[200][1]), 1 / (1 - std::stod(reflectance)), 1e-6);
  }
}

TEST(LinearWalks, DivergentSystemsAreRefused) {
  const auto result = find_experiment("linear-walks")->run({{"system", std::string("divergent")}}, {});
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find("the spectral radius of A is 2.45"), std::string::npos);
}

TEST(VarianceReduction, EveryTechniqueHelpsAndHurts) {
  const auto result = run("variance-reduction", {{"samples", "256"}});
  ASSERT_EQ(result.table.rows.size(), 19u);
  std::map<std::string, std::set<std::string>> results;
  for (const auto& row : result.table.rows)
    results[std::get<std::string>(row.front())].insert(std::get<std::string>(row.back()));
  EXPECT_EQ(results.size(), 8u);
  for (const auto& [technique, found] : results)
    EXPECT_EQ(found, (std::set<std::string>{"helps", "hurts"})) << technique;
}

// Columns: constant, balance, power 2, maximum, cutoff 0.5.
TEST(Mis, VariancesAreTheTabulatedOnes) {
  struct Row {
    const char *sigma, *width;
    std::array<double, 5> variances;
  };
  const Row rows[] = {{"0.01", "0.01", {141.25, 95.523, 65.177, 23.445, 98.656}},
                      {"0.01", "0.2", {16.068, 0.53928, 0.14632, 0.17340, 0.15420}},
                      {"0.05", "0.01", {83.37, 6.2452, 0.20236, 2.2251e-3, 2.2251e-3}},
                      {"0.05", "0.05", {5.6501, 3.8209, 2.6071, 0.93781, 3.9462}},
                      {"0.2", "0.05", {3.9611, 0.4309, 0.022579, 3.3628e-4, 3.3628e-4}},
                      {"0.2", "0.2", {0.35313, 0.23881, 0.16294, 0.058613, 0.24664}}};
  for (const Row& row : rows) {
    const auto result = run("mis", {{"sigma", row.sigma}, {"width", row.width}, {"samples", "64"}});
    const std::array<size_t, 5> order{0, 1, 3, 4, 2};
    for (size_t i = 0; i < order.size(); ++i)
      EXPECT_NEAR(std::get<double>(result.table.rows[order[i]][2]), row.variances[i], 1e-3 * row.variances[i])
          << row.sigma << ' ' << row.width << ' ' << i;
    // No weights have less variance than the optimal ones.
    for (size_t i = 0; i < 6; ++i)
      EXPECT_GE(std::get<double>(result.table.rows[i][2]), std::get<double>(result.table.rows[6][2]) * (1 - 1e-9));
  }
}

TEST(Mis, VariancesOfPolynomialsAreTheTabulatedOnes) {
  const std::pair<const char*, std::array<double, 5>> problems[] = {
      {"linear", {0.0208333, 0.0111110, 0.0131462, 0.0132502, 0.0729167}},
      {"square", {0.0256944, 0.0187211, 0.0189385, 0.0181760, 0.0366319}}};
  for (const auto& [problem, variances] : problems) {
    const auto result = run("mis", {{"problem", problem}});
    expect_checks(result, problem);
    for (size_t i = 0; i < variances.size(); ++i)
      EXPECT_NEAR(std::get<double>(result.table.rows[i][2]), variances[i], 2e-7) << problem << ' ' << i;
  }
  // The second density has no variance for f = x, and the optimal weights use it alone.
  EXPECT_NEAR(std::get<double>(run("mis", {{"problem", "linear"}}).table.rows[6][2]), 0, 1e-12);
}

TEST(ErrorBounds, RareEventsDeviateFromTheLimit) {
  const auto result = run("error-bounds", {{"integrand", "rare"}, {"repeats", "5000"}});
  // Two standard deviations: 6 % of the means of 64 samples contain a one, and none of the others exceeds one.
  const auto& row = result.table.rows[2];
  EXPECT_GT(std::get<double>(row[1]), 1.15 * std::get<double>(row[2]));
  EXPECT_LE(std::get<double>(row[1]), std::get<double>(row[3]));
}

TEST(RatioEstimator, IsExactInAnImageOfOneValue) {
  const auto result = run("ratio-estimator", {{"image", "flat"}});
  expect_checks(result, "flat");
  for (const auto& row : result.table.rows) {
    EXPECT_NEAR(std::get<double>(row[3]), 0, 1e-12);
    EXPECT_NEAR(std::get<double>(row[4]), std::sqrt(1 / (3 * std::get<double>(row[0]))),
                0.05 * std::get<double>(row[4]));
  }
}

TEST(LebesgueSums, DirichletsFunctionHasNoRiemannIntegral) {
  for (const char* function : {"steps", "dirichlet"})
    expect_checks(run("lebesgue-sums", {{"function", function}}), function);
}

}  // namespace
}  // namespace etendue::experiments
