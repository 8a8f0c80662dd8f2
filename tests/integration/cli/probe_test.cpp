// `etendue probe`: light meters on the command line.
#include <nlohmann/json.hpp>

#include "integration/cli/cli.h"

namespace etendue::test {
namespace {

using nlohmann::json;

TEST_F(Cli, ProbeMeasuresInRadiometricAndPhotometricUnits) {
  const Outcome r = run("probe cornell --size 64x64 --at 32 61 --spp 64 --efficacy maximal --json");
  ASSERT_EQ(r.code, 0) << r.err;
  const auto j = json::parse(r.out);
  EXPECT_GT(j["irradiance"]["value"][0].get<double>(), 0);
  EXPECT_NEAR(j["normal"][1].get<double>(), 1, 1e-3);
  const auto& e = j["irradiance"];
  const double y = 0.212671 * e["value"][0].get<double>() + 0.71516 * e["value"][1].get<double>() +
                   0.072169 * e["value"][2].get<double>();
  EXPECT_NEAR(e["photometric"].get<double>(), 683 * y, 0.01 * y);
}

TEST_F(Cli, ProbeReportsErrors) {
  expect_error("probe cornell --at 900000 1", 2, "outside");
  expect_error("probe cornell --efficacy candles", 2, "equal-energy");
  expect_error("probe nowhere.glb", 3, "nowhere.glb");
}

}  // namespace
}  // namespace etendue::test
