// `etendue lab`: the list of experiments, results in all formats, and error messages.
#include <nlohmann/json.hpp>

#include "integration/cli/cli.h"

namespace etendue::test::lab_test {
namespace {

using nlohmann::json;

TEST_F(Cli, LabListsItsExperiments) {
  const Outcome text = run("lab");
  ASSERT_EQ(text.code, 0) << text.err;
  EXPECT_NE(text.out.find("quadrature"), std::string::npos);
  const auto list = json::parse(run("lab --json").out);
  const auto registry = json::parse(run("list experiments --json").out);
  EXPECT_EQ(list.size(), registry.size());
  EXPECT_GE(list.size(), 12u);
  for (const json& entry : registry)
    for (const json& parameter : entry["parameters"]) EXPECT_FALSE(parameter["doc"].get<std::string>().empty());
}

TEST_F(Cli, LabWritesAllFormats) {
  for (const char* format : {"csv", "json", "png", "svg"}) {
    const Outcome r = run("lab lebesgue-sums --set parts=64 -o sums." + std::string(format));
    ASSERT_EQ(r.code, 0) << r.err;
    EXPECT_GT(slurp(folder_ / ("sums." + std::string(format))).size(), 500u) << format;
  }
  EXPECT_EQ(slurp(folder_ / "sums.png").substr(1, 3), "PNG");
  EXPECT_NE(slurp(folder_ / "sums.svg").find("</svg>"), std::string::npos);
  EXPECT_EQ(json::parse(slurp(folder_ / "sums.json")), json::parse(run("lab lebesgue-sums --set parts=64 --json").out));
}

TEST_F(Cli, LabResultsDependOnTheSeedAlone) {
  const std::string command = "lab estimators --set samples=256 --json";
  EXPECT_EQ(run(command).out, run(command).out);
  EXPECT_NE(run(command).out, run(command + " --seed 1").out);
}

TEST_F(Cli, LabReportsErrors) {
  expect_error("lab quadratur", 2, "there is no experiment 'quadratur'");
  expect_error("lab quadrature --set size=3", 2, "no parameter 'size'");
  expect_error("lab quadrature --set dimension", 2, "NAME=VALUE");
  expect_error("lab quadrature --set dimension=0", 2, "an integer from 1 to 64");
  expect_error("lab quadrature --set dimension=10000", 2, "an integer from 1 to 64");
  expect_error("lab quadrature --set evaluations=0", 2, "an integer from 64");
  expect_error("lab quadrature --set sampler=magic", 2, "there is no sampler 'magic'");
  expect_error("lab quadrature --set integrand=sinc", 3, "the integrand is not finite at x = (0, 0)");
  expect_error("lab sampling --set density=peaks --set method=inversion", 2, "use rejection or metropolis");
  expect_error("lab markov --set chain=stay", 3, "independent stationary distributions");
  expect_error("lab random-walks --set equation=logarithmic", 3, "the Neumann series diverges");
  expect_error("lab fredholm --set equation=constant --set lambda=1", 3, "1 is an eigenvalue of the kernel");
  expect_error("lab lebesgue-sums -o sums.txt", 2, "use .csv, .json, .png or .svg");
  expect_error("lab lebesgue-sums -o /proc/nothing/sums.csv", 4, "/proc");
}

}  // namespace
}  // namespace etendue::test::lab_test
