// `etendue spectrum` and `list spectra`: values and error messages.
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "integration/cli/cli.h"

namespace etendue::test::spectrum_test {
namespace {

using nlohmann::json;

TEST_F(Cli, SpectraAreListed) {
  const Outcome listed = run("list spectra --json");
  ASSERT_EQ(listed.code, 0) << listed.err;
  std::map<std::string, int> classes;
  for (const auto& entry : json::parse(listed.out)) ++classes[entry["class"].get<std::string>()];
  const std::map<std::string, int> expected{
      {"illuminant", 4}, {"metal", 4}, {"glass", 5}, {"absorption coefficient", 1}, {"scattering coefficient", 1}};
  EXPECT_EQ(classes, expected);
}

TEST_F(Cli, SpectrumShowsColorAndEfficacy) {
  const Outcome r = run("spectrum d65 --json");
  ASSERT_EQ(r.code, 0) << r.err;
  const json j = json::parse(r.out);
  EXPECT_NEAR(j["chromaticity"][0].get<double>(), 0.31272, 1e-4);
  for (const auto& c : j["rgb"]) EXPECT_NEAR(c.get<double>(), 1, 1e-6);
  EXPECT_EQ(run("spectrum 2700K").code, 0);
}

// More functions approximate the illuminant better than three numbers of its colour.
TEST_F(Cli, SpectrumComparesApproximations) {
  const Outcome r = run("spectrum a --basis 16 --json");
  ASSERT_EQ(r.code, 0) << r.err;
  const json list = json::parse(r.out)["approximations"];
  ASSERT_EQ(list.size(), 5U);
  EXPECT_EQ(list[0]["approximation"], "boxes");
  for (const json& j : list) EXPECT_LT(j["relative_error"].get<double>(), 0.3) << j;
  EXPECT_LT(list[0]["relative_error"], list[4]["relative_error"]);
  EXPECT_LT(list[4]["color_error"].get<double>(), 0.02);
  expect_error("spectrum a --basis 100", 2, "--basis");
}

TEST_F(Cli, SpectrumReportsErrors) {
  expect_error("spectrum 50K", 2, "from 1000 to");
  expect_error("spectrum missing.csv", 3, "missing.csv");
  std::ofstream(folder_ / "twice.csv") << "400,1\n400,2\n";
  expect_error("spectrum twice.csv", 3, "the wavelength occurs twice");
}

}  // namespace
}  // namespace etendue::test::spectrum_test
