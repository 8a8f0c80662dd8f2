// The experiments of the laboratory: every check of every experiment holds.
//
// The tolerances of the checks are 4.5 standard errors, three for slopes. With the fixed seed there is no false alarm
// unless the estimates change.
#include "experiments/experiment.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "experiments/experiment_output.h"

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

TEST(Quadrature, UndefinedIntegrandIsAnError) {
  const Experiment* experiment = find_experiment("quadrature");
  const auto result = experiment->run({{"integrand", std::string("sinc")}}, {});
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find("trapezoid: the integrand is not finite at x = (0, 0)"), std::string::npos)
      << result.error().message;
}

TEST(Quadrature, ManyDimensionsLeaveOutTensorProducts) {
  const auto result = run("quadrature", {{"dimension", "64"}, {"evaluations", "64"}});
  EXPECT_EQ(result.notes.size(), 4u);
  EXPECT_EQ(std::get<ErrorChart>(result.charts[0]).curves.size(), 2u);
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
