// `etendue bsdf`: checks, values, drawings, and error messages.
#include <nlohmann/json.hpp>

#include "integration/cli/cli.h"

namespace etendue::test::bsdf_test {
namespace {

using nlohmann::json;

TEST_F(Cli, BsdfMeasuresAModel) {
  const Outcome r = run("bsdf phong --set diffuse=0 --set exponent=10 --json");
  ASSERT_EQ(r.code, 0) << r.err;
  const auto j = json::parse(r.out);
  EXPECT_EQ(j["model"], "phong");
  EXPECT_EQ(j["parameters"]["exponent"], 10);
  EXPECT_FALSE(j["badges"]["reciprocal"]["holds"].get<bool>());
  EXPECT_TRUE(j["badges"]["well-sampled"]["holds"].get<bool>());
  EXPECT_NEAR(j["albedo"][0]["albedo"][0].get<double>(), 0.3 * 0.5236, 2e-3);
}

TEST_F(Cli, BsdfComparesTwoAndDrawsThem) {
  const Outcome r =
      run("bsdf gltf --set roughness=0.4 --against modified-phong --set-against exponent=50 --out d --json");
  ASSERT_EQ(r.code, 0) << r.err;
  const auto j = json::parse(r.out);
  ASSERT_EQ(j.size(), 2u);
  EXPECT_EQ(j[1]["parameters"]["exponent"], 50);
  for (const char* name : {"polar.svg", "albedo.svg", "lobe.svg", "lobe-against.svg"})
    EXPECT_NE(slurp(folder_ / "d" / name).find("</svg>"), std::string::npos) << name;
}

TEST_F(Cli, BsdfAnalysesAMaterialOfAScene) {
  const Outcome r = run("bsdf --scene cornell-spheres --material 0 --json");
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_EQ(json::parse(r.out)["model"], "gltf");
  expect_error("bsdf --scene cornell --material nobody", 2, "nobody");
}

TEST_F(Cli, BsdfReportsErrors) {
  expect_error("bsdf fong", 2, "phong");
  expect_error("bsdf phong --set exponents=3", 2, "exponent");
  expect_error("bsdf phong --set exponent", 2, "NAME=VALUE");
  expect_error("bsdf", 2, "list materials");
  expect_error("bsdf lambert --out /proc/nothing/here", 4, "/proc");
}

// A table written by the virtual gonioreflectometer can be used as a model.
TEST_F(Cli, BsdfTableCanBeUsedAsAModel) {
  ASSERT_EQ(run("bsdf lambert --set diffuse=0.5 --table t.brdf --steps 8 16").code, 0);
  const Outcome r = run("bsdf tabulated --set source=t.brdf --json");
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_NEAR(json::parse(r.out)["hemispherical_albedo"].get<double>(), 0.5, 1e-3);
  expect_error("bsdf lambert --table nowhere/t.brdf", 4, "nowhere");
}

// An image stores the model of its scene: a rendering with --like gives the same image.
TEST_F(Cli, ImagesStoreTheModel) {
  ASSERT_EQ(
      run("render cornell --size 24x24 --spp 4 --set material.0.model=phong --set material.0.phong.exponent=7 -o a.exr")
          .code,
      0);
  ASSERT_EQ(run("render --like a.exr -o b.exr").code, 0);
  ASSERT_EQ(run("render cornell --size 24x24 --spp 4 -o c.exr").code, 0);
  EXPECT_EQ(json::parse(run("compare a.exr b.exr --json").out)["mse"], 0);
  EXPECT_GT(json::parse(run("compare a.exr c.exr --json").out)["mse"], 0);
}

}  // namespace
}  // namespace etendue::test::bsdf_test
