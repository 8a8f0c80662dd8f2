// `etendue phase`, `list phase-functions` and `list media`: values, drawings, and error messages.
#include <nlohmann/json.hpp>

#include "integration/cli/cli.h"

namespace etendue::test::phase_test {
namespace {

using nlohmann::json;

// Every entry of the registry passes its checks.
TEST_F(Cli, PhaseChecksEveryPhaseFunction) {
  const Outcome listed = run("list phase-functions --json");
  ASSERT_EQ(listed.code, 0) << listed.err;
  const auto list = json::parse(listed.out);
  EXPECT_GE(list.size(), 11u);
  for (const auto& entry : list) {
    const Outcome r = run("phase " + entry["name"].get<std::string>() + " --json");
    ASSERT_EQ(r.code, 0) << r.err;
    const auto checks = json::parse(r.out)["checks"];
    for (const char* name : {"non-negative", "normalised", "mean-cosine", "well-sampled"})
      EXPECT_TRUE(checks[name]["holds"].get<bool>()) << entry["name"] << ' ' << checks[name]["reason"];
  }
}

TEST_F(Cli, PhaseComparesTwoAndDrawsThem) {
  const Outcome r = run("phase henyey-greenstein --set g=0.9 --against mie-murky --out d --json");
  ASSERT_EQ(r.code, 0) << r.err;
  const auto j = json::parse(r.out);
  ASSERT_EQ(j.size(), 2u);
  EXPECT_NEAR(j[0]["mean_cosine"].get<double>(), 0.9, 1e-5);
  EXPECT_NEAR(j[1]["mean_cosine"].get<double>(), 8.0 / 17, 1e-5);
  EXPECT_NE(slurp(folder_ / "d" / "phase.svg").find("</svg>"), std::string::npos);
}

TEST_F(Cli, PhaseReportsErrors) {
  expect_error("phase magic", 2, "henyey-greenstein");
  expect_error("phase henyey-greenstein --set g=1.5", 2, "from -1 to 1");
  expect_error("phase henyey-greenstein --set h=0", 2, "no parameter 'h'");
  expect_error("phase tabulated --set values=1", 2, "give 2 to 1024");
}

TEST_F(Cli, MediaAreListedWithSources) {
  const Outcome r = run("list media --json");
  ASSERT_EQ(r.code, 0) << r.err;
  bool has_milk = false;
  for (const auto& medium : json::parse(r.out)) {
    if (medium["name"] != "skim-milk") continue;
    has_milk = true;
    EXPECT_NEAR(medium["scattering"][0].get<double>(), 700, 1e-3);
    EXPECT_NE(medium["doc"].get<std::string>().find("Jensen"), std::string::npos);
  }
  EXPECT_TRUE(has_milk);
}

}  // namespace
}  // namespace etendue::test::phase_test
