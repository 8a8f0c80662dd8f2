// `etendue trace`: one sample of a pixel.
#include <nlohmann/json.hpp>

#include "integration/cli/cli.h"

namespace etendue::test::trace_test {
namespace {

using nlohmann::json;

TEST_F(Cli, TraceShowsASampleWhoseSumIsThatOfTheFilm) {
  const Outcome r = run("trace cornell --size 64x64 --pixel 20,40 --sample 3 --json");
  ASSERT_EQ(r.code, 0) << r.err;
  const auto j = json::parse(r.out);
  EXPECT_EQ(j["pixel"], json({20, 40}));
  EXPECT_EQ(j["sample"], 3);
  EXPECT_EQ(j["radiance"], j["film_sample"]);
  EXPECT_GE(j["vertices"].size(), 1u);
}

TEST_F(Cli, TraceDrawsThePathsOverAnImage) {
  ASSERT_EQ(run("render cornell --size 64x64 --spp 4 -o a.png").code, 0);
  const Outcome r = run("trace cornell --size 64x64 --svg a.svg --background a.png");
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_NE(r.out.find("equal to the sample of the film"), std::string::npos) << r.out;
  EXPECT_TRUE(fs::exists(folder_ / "a.svg"));
  expect_error("trace cornell --size 32x32 --svg a.svg --background a.png", 2, "32x32");
}

TEST_F(Cli, TraceReportsErrors) {
  expect_error("trace cornell --size 64x64 --pixel 64,0", 2, "64x64");
  expect_error("trace cornell --pixel 3:4", 2, "320,240");
  expect_error("trace cornell --set render.integrator=bdpt", 2, "any pixel");
  expect_error("trace cornell --set render.integrator=photonmap", 2, "photons");
  expect_error("trace nowhere.glb", 3, "nowhere.glb");
}

}  // namespace
}  // namespace etendue::test::trace_test
