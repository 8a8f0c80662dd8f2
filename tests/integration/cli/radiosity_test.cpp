// `etendue radiosity`: solvers, charts, patches, hierarchical form factors, and what it reports.
#include <nlohmann/json.hpp>
#include <sstream>

#include "integration/cli/cli.h"

namespace etendue::test::radiosity_test {
namespace {

using nlohmann::json;

constexpr const char* kSmallMesh = "radiosity cornell --set radiosity.patches=150 --set radiosity.rays=64 ";

TEST_F(Cli, RadiosityWritesChartsAndPatches) {
  const Outcome r = run(std::string(kSmallMesh) + "--solver all --chart a.svg --patches p.csv --json");
  ASSERT_EQ(r.code, 0) << r.err;
  const json j = json::parse(r.out);
  EXPECT_EQ(j["solvers"].size(), 8u);
  for (const json& solver : j["solvers"]) {
    EXPECT_EQ(solver["status"], "converged");
    EXPECT_EQ(solver["seconds_of_sweeps"].size(), solver["residuals"].size());
  }
  const std::string chart = slurp(folder_ / "a.svg");
  for (const char* name : {"southwell", "jacobi", "sweeps"}) EXPECT_NE(chart.find(name), std::string::npos) << name;
  std::istringstream table(slurp(folder_ / "p.csv"));
  std::string line;
  std::getline(table, line);
  EXPECT_EQ(line, "patch,side,x,y,z,area,closure,asymmetry,radiosity,unshot");
  size_t rows = 0;
  while (std::getline(table, line)) ++rows;
  EXPECT_GT(rows, j["patches"].get<size_t>() / 2);
  EXPECT_LE(rows, j["elements"].get<size_t>());
  ASSERT_EQ(run(std::string(kSmallMesh) + "--chart b.svg --chart-axis seconds").code, 0);
  EXPECT_NE(slurp(folder_ / "b.svg").find("seconds"), std::string::npos);
}

TEST_F(Cli, RadiosityWithLinks) {
  const Outcome r = run(std::string(kSmallMesh) + "--set radiosity.meshing=quadtree --links 0.02 --json");
  ASSERT_EQ(r.code, 0) << r.err;
  const json hierarchy = json::parse(r.out)["hierarchy"];
  EXPECT_GT(hierarchy["links"], 100);
  EXPECT_NEAR(hierarchy["closure"].get<double>(), json::parse(r.out)["closure"]["mean"].get<double>(), 0.03);
  EXPECT_LT(hierarchy["difference"], 0.1);
  expect_error(std::string(kSmallMesh) + "--links 0.02", 2, "radiosity.meshing=quadtree");
}

// A document whose solver diverges renders direct light and says so once.
TEST_F(Cli, RenderReportsDivergence) {
  const std::string render =
      "render cornell --integrator radiosity --set radiosity.patches=60 --set radiosity.rays=32 --size 16x16 --spp 2 "
      "--set radiosity.solver=sor --json - ";
  const Outcome r = run(render + "--set radiosity.relaxation=2.5 -o a.exr");
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_NE(r.err.find("direct light only"), std::string::npos) << r.err;
  EXPECT_EQ(r.err.find("direct light only"), r.err.rfind("direct light only")) << r.err;
  const Outcome converged = run(render + "-o b.exr");
  EXPECT_EQ(converged.err.find("direct light only"), std::string::npos) << converged.err;
}

}  // namespace
}  // namespace etendue::test::radiosity_test
