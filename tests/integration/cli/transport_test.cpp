// Layers of light paths, `etendue energy` and `etendue importance` on the command line.
#include <nlohmann/json.hpp>

#include "image/image.h"
#include "integration/cli/cli.h"

namespace etendue::test::transport_test {
namespace {

using nlohmann::json;

TEST_F(Cli, LayersOfLightPathsAreRecordedWithTheImage) {
  const Outcome r =
      run("render cornell --size 32x32 --spp 4 --aov 'bounces:2,direct,caustics=ED(G|S)+L,depth' -o a.exr");
  ASSERT_EQ(r.code, 0) << r.err;
  const auto image = image::read_exr(folder_ / "a.exr");
  ASSERT_TRUE(image);
  for (const char* name : {"bounce-0", "bounce-1", "bounce-rest", "direct", "caustics", "depth"})
    EXPECT_NE(image->find(name), nullptr) << name;
  const auto values = [&](const char* name) { return image->find(name)->pixels; };
  const auto zero = values("bounce-0"), one = values("bounce-1"), rest = values("bounce-rest");
  EXPECT_EQ(one, values("direct"));
  const auto& whole = image->layers.at(0).pixels;
  ASSERT_EQ(whole.size(), one.size());
  for (size_t i = 0; i < whole.size(); ++i) EXPECT_NEAR(zero[i] + one[i] + rest[i], whole[i], 1e-4f * whole[i] + 1e-6f);
}

// The image does not depend on the layers.
TEST_F(Cli, LayersOfLightPathsLeaveTheImageUnchanged) {
  ASSERT_EQ(run("render cornell --size 32x32 --spp 4 -o a.exr").code, 0);
  ASSERT_EQ(run("render cornell --size 32x32 --spp 4 --aov bounces -o b.exr").code, 0);
  const auto a = image::read_exr(folder_ / "a.exr"), b = image::read_exr(folder_ / "b.exr");
  const auto &x = a->layers.at(0).pixels, &y = b->layers.at(0).pixels;
  for (size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(x[i], y[i], 1e-4f * x[i] + 1e-6f);
}

TEST_F(Cli, LayersOfLightPathsThatCannotBeRecordedAreErrors) {
  expect_error("render cornell --spp 1 --integrator bdpt --aov bounces -o a.exr", 2, "recorded by the integrators");
  expect_error("render cornell --spp 1 --aov 'x=EQ' -o a.exr", 2, "--aov: x:");
  expect_error("render cornell --spp 1 --aov bounce-9 -o a.exr", 2, "NAME=EXPRESSION");
  expect_error("render cornell --spp 1 --aov bounces --checkpoint 1 -o a.exr", 2, "checkpoints do not hold");
}

TEST_F(Cli, EnergyBalancesEmissionAndAbsorption) {
  const Outcome r = run("energy cornell --light-paths 20000 --json");
  ASSERT_EQ(r.code, 0) << r.err;
  const json j = json::parse(r.out);
  const double emitted = j["emitted"]["value"], absorbed = j["absorbed"]["value"], escaped = j["escaped"]["value"];
  EXPECT_GT(absorbed, 0);
  EXPECT_GT(escaped, 0);
  EXPECT_NEAR(absorbed + escaped, emitted, 0.05 * emitted);
  EXPECT_NE(run("energy cornell --light-paths 2000").out.find("absorbed by objects"), std::string::npos);
}

TEST_F(Cli, ImportanceWritesAPicture) {
  const Outcome r = run("importance cornell --size 32x32 --spp 4 -o i.png --view 0,1,3:0,1,0");
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_TRUE(fs::exists(folder_ / "i.png"));
  EXPECT_NE(r.out.find("mean radiance of the image"), std::string::npos);
  expect_error("importance cornell --view nowhere", 2, "is no camera of the scene");
  expect_error("importance cornell -o i.jpg", 2, "FILE.png or FILE.exr");
}

}  // namespace
}  // namespace etendue::test::transport_test
