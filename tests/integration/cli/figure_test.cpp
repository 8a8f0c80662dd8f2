// `etendue figure` and `etendue pattern`: lists, files and error messages.
#include <nlohmann/json.hpp>

#include "integration/cli/cli.h"

namespace etendue::test::figure_test {
namespace {

using nlohmann::json;

TEST_F(Cli, FigureWritesOneFile) {
  ASSERT_EQ(run("figure 7.4").code, 0);
  EXPECT_EQ(slurp(folder_ / "figure-7.4.png").substr(1, 3), "PNG");
  ASSERT_EQ(run("figure 7.4 -o halton.svg").code, 0);
  EXPECT_NE(slurp(folder_ / "halton.svg").find("</svg>"), std::string::npos);
}

TEST_F(Cli, FigureReportsErrors) {
  expect_error("figure 5.1", 3, "figure 5.1 is not made: A diagram");
  expect_error("figure 11.1", 2, "there is no figure '11.1'");
  expect_error("figure --all", 2, "give a folder");
  expect_error("figure 7.4 --all --out x", 2, "a number or --all");
  expect_error("figure 7.4 -o figure.txt", 2, ".png or .svg");
}

TEST_F(Cli, PatternMeasuresPoints) {
  const json values = json::parse(run("pattern hammersley --points 64 --set scrambling=owen --json").out);
  EXPECT_EQ(values[0]["name"], "star discrepancy");
  EXPECT_GT(values[0]["mean"].get<double>(), 0.01);
  EXPECT_LT(values[0]["mean"].get<double>(), 0.1);
  for (const char* format : {"svg", "png", "csv"}) {
    ASSERT_EQ(run("pattern sobol --points 16 -o points." + std::string(format)).code, 0);
    EXPECT_GT(slurp(folder_ / ("points." + std::string(format))).size(), 100u) << format;
  }
}

TEST_F(Cli, PatternReportsErrors) {
  expect_error("pattern magic", 2, "there is no sampler 'magic'");
  expect_error("pattern sobol --points 0", 2, "--points");
  expect_error("pattern sobol --dimensions 0 70000", 2, "there is no dimension 70000");
  expect_error("pattern sobol --dimensions 3", 2, "at least two dimensions");
  expect_error("pattern halton --set size=3", 2, "has no parameter 'size'");
  expect_error("pattern sobol -o points.txt", 2, ".svg, .png or .csv");
}

}  // namespace
}  // namespace etendue::test::figure_test
