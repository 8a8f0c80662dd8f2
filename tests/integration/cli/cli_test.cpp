// The command line as used by scripts: exit codes, one-line errors, results on standard output, complete files.
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "integration/cli/cli.h"

namespace etendue::test::cli_test {
namespace {

TEST_F(Cli, RenderWritesTheImageAndItsStatistics) {
  const Outcome r = run("render cornell --size 24x24 --spp 4 --seed 3 -o a.exr --json -");
  ASSERT_EQ(r.code, 0) << r.err;
  const auto j = nlohmann::json::parse(r.out);
  for (const char* key : {"integrator", "sampler", "spp", "seconds", "rays", "width", "height", "threads", "seed",
                          "rmse_estimate", "rejected", "khat", "health", "peak_rss_bytes", "model"})
    EXPECT_TRUE(j.contains(key)) << key;
  EXPECT_EQ(j["health"]["verdict"], "unknown");
  EXPECT_EQ(j["spp"], 4);
  EXPECT_EQ(j["seed"], 3);
  EXPECT_EQ(j["rejected"]["nan"], 0);
  EXPECT_TRUE(j["rejected"]["first"].empty());
  EXPECT_TRUE(fs::exists(folder_ / "a.exr"));
}

TEST_F(Cli, RenderReportsTheReliabilityOfItsError) {
  const Outcome tame = run("render cornell --size 32x32 --spp 32 -o a.exr --json -");
  ASSERT_EQ(tame.code, 0) << tame.err;
  const auto j = nlohmann::json::parse(tame.out);
  EXPECT_TRUE(j["khat"].is_number());
  EXPECT_EQ(j["health"]["verdict"], "healthy");
  for (const char* key : {"reason", "khat_heavy_share", "vov", "brightest_share", "samples"})
    EXPECT_TRUE(j["health"].contains(key)) << key;
  EXPECT_EQ(tame.err.find("unreliable"), std::string::npos);
}

// A point light inside a lampshade.
TEST_F(Cli, UnreliableErrorsAreReportedOnStandardError) {
  const char* data = std::getenv("ETENDUE_TEST_DATA");
  if (!data) GTEST_SKIP() << "set ETENDUE_TEST_DATA";
  const Outcome r =
      run(std::string("render ") + data +
          "/gltf/LightsPunctualLamp/glTF/LightsPunctualLamp.gltf --size 96x64 --spp 32 -o b.exr --json -");
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_EQ(nlohmann::json::parse(r.out)["health"]["verdict"], "unreliable") << r.out;
  EXPECT_NE(r.err.find("b.exr: unreliable: "), std::string::npos) << r.err;
}

TEST_F(Cli, ReweightedFirefliesAffectThePngOnly) {
  ASSERT_EQ(run("render cornell --size 24x24 --spp 8 --integrator path-pure -o a.exr --png a.png").code, 0);
  ASSERT_EQ(run("render cornell --size 24x24 --spp 8 --integrator path-pure --set film.fireflies=reweight -o b.exr "
                "--png b.png")
                .code,
            0);
  EXPECT_EQ(nlohmann::json::parse(run("compare a.exr b.exr --json").out)["mse"], 0);
  EXPECT_GT(nlohmann::json::parse(run("compare a.png b.png --json").out)["mse"], 0);
  EXPECT_NE(slurp(folder_ / "b.exr").find("reweighted.R"), std::string::npos);
  EXPECT_EQ(slurp(folder_ / "a.exr").find("reweighted.R"), std::string::npos);
}

TEST_F(Cli, LikeReproducesTheImage) {
  ASSERT_EQ(run("render cornell --size 24x24 --spp 4 --seed 3 --set material.5.metallic=1 --set film.filter=tent "
                "--exposure 1 -o a.exr")
                .code,
            0);
  ASSERT_EQ(run("render --like a.exr --spp 4 -o b.exr").code, 0);
  const Outcome r = run("compare a.exr b.exr --json");
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_EQ(nlohmann::json::parse(r.out)["mse"], 0);
}

TEST_F(Cli, PathExpressionIsStoredInImages) {
  ASSERT_EQ(run("render cornell --size 24x24 --spp 4 --paths 'E(D|G)L' -o a.exr").code, 0);
  ASSERT_EQ(run("render --like a.exr --spp 4 -o b.exr").code, 0);
  ASSERT_EQ(run("render --like a.exr --spp 4 --set film.paths= -o all.exr").code, 0);
  ASSERT_EQ(run("render cornell --size 24x24 --spp 4 -o whole.exr").code, 0);
  const auto mse = [&](const std::string& files) {
    return nlohmann::json::parse(run("compare " + files + " --json").out)["mse"].get<double>();
  };
  EXPECT_EQ(mse("a.exr b.exr"), 0);
  EXPECT_EQ(mse("all.exr whole.exr"), 0);
  EXPECT_GT(mse("a.exr whole.exr"), 0);
}

TEST_F(Cli, AnIntegratorWithoutTheRequestedPathsReportsIt) {
  const Outcome r = run("render cornell --size 8x8 --spp 1 --integrator raycast --paths EDDL -o a.exr");
  EXPECT_EQ(r.code, 0);
  EXPECT_NE(r.err.find("raycast finds E[D|G]L, none of EDDL"), std::string::npos) << r.err;
}

TEST_F(Cli, IncompatibilityIsAWarning) {
  const std::string what = "render cornell --size 8x8 --spp 1 --integrator light-pure -o a.exr --json -";
  const Outcome r = run(what);
  EXPECT_EQ(r.code, 0);
  EXPECT_NE(r.err.find("set camera.lens-radius"), std::string::npos) << r.err;
  EXPECT_EQ(nlohmann::json::parse(r.out)["obstacle"], r.err.substr(9, r.err.size() - 10));
  const Outcome clear = run(what + " --set camera.lens-radius=0.1");
  EXPECT_EQ(clear.err, "");
  EXPECT_TRUE(nlohmann::json::parse(clear.out)["obstacle"].is_null());
}

TEST_F(Cli, AdaptiveSamplingWithAnUnsuitableIntegratorIsAUsageError) {
  expect_error("render cornell --spp 1 --set render.adaptive=rmse --integrator light -o a.exr", 2, "pixel by pixel");
  expect_error("bench cornell --methods light:adaptive=rmse --samples 2 --out d", 2, "pixel by pixel");
}

TEST_F(Cli, TechniquesAreExcludedByName) {
  const Outcome r = run("render cornell --size 8x8 --spp 1 --integrator bdpt --set bdpt.without=0,* -o a.exr --json -");
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_EQ(nlohmann::json::parse(r.out)["certificate"]["bias"], "biased");
  expect_error("render cornell --spp 1 --integrator bdpt --set 'bdpt.without=0;1' -o a.exr", 2, "is not a technique");
}

TEST_F(Cli, IntegratorsAreListedByGroup) {
  const Outcome r = run("list integrators --json");
  ASSERT_EQ(r.code, 0) << r.err;
  const auto list = nlohmann::json::parse(r.out);
  EXPECT_EQ(list[0]["group"], "gathering");
  for (const auto& integrator : list) EXPECT_FALSE(integrator["group"].get<std::string>().empty());
}

TEST_F(Cli, CompareReturnsOneAboveTheThreshold) {
  ASSERT_EQ(run("render cornell --size 24x24 --spp 2 -o a.exr").code, 0);
  ASSERT_EQ(run("render cornell --size 24x24 --spp 2 --seed 1 -o b.exr").code, 0);
  EXPECT_EQ(run("compare a.exr b.exr --max-rmse 1e-9").code, 1);
  EXPECT_EQ(run("compare a.exr b.exr --max-rmse 1e9 --heatmap h.png").code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "h.png"));
}

TEST_F(Cli, CompareComputesFlipWithTheDisplaySettingsOfTheReference) {
  ASSERT_EQ(run("render cornell --size 32x32 --spp 2 -o a.exr").code, 0);
  ASSERT_EQ(run("render cornell --size 32x32 --spp 2 --seed 1 -o plain.exr").code, 0);
  ASSERT_EQ(run("render cornell --size 32x32 --spp 2 --seed 1 --exposure -12 -o dark.exr").code, 0);
  const auto flip = [&](const std::string& reference) {
    return nlohmann::json::parse(run("compare a.exr " + reference + " --json").out)["flip"].get<double>();
  };
  EXPECT_EQ(flip("a.exr"), 0);
  EXPECT_GT(flip("plain.exr"), 0.01);
  EXPECT_LT(flip("dark.exr"), 0.1 * flip("plain.exr"));
  EXPECT_NE(run("compare a.exr plain.exr").out.find("\nflip "), std::string::npos);
}

// The error of another measure ends the rendering, and the true error agrees with it.
TEST_F(Cli, RenderStopsAtTheErrorOfAMeasure) {
  ASSERT_EQ(run("render cornell --size 32x32 --spp 4096 --seed 9 -o truth.exr").code, 0);
  for (const std::string measure : {"rmse", "relative", "displayed"}) {
    const Outcome r =
        run("render cornell --size 32x32 --spp 4000 --error 0.04 --error-measure " + measure + " -o a.exr --json -");
    ASSERT_EQ(r.code, 0) << r.err;
    const auto j = nlohmann::json::parse(r.out);
    EXPECT_EQ(j["error_measure"], measure);
    EXPECT_LE(j["error"].get<double>(), 0.04) << measure;
    EXPECT_GT(j["spp"].get<int>(), 2) << measure;
    EXPECT_LT(j["spp"].get<int>(), 4000) << measure;
    const auto truth = nlohmann::json::parse(run("compare a.exr truth.exr --json").out)[measure].get<double>();
    EXPECT_GT(truth, 0.8 * j["error_interval"][0].get<double>()) << measure;
    EXPECT_LT(truth, 1.2 * j["error_interval"][1].get<double>()) << measure;
  }
  // The measure is stored with the image.
  const auto again = nlohmann::json::parse(run("render --like a.exr --spp 4 -o b.exr --json -").out);
  EXPECT_EQ(again["error_measure"], "displayed");
}

TEST_F(Cli, CompareHasNoErrorForMissingImages) {
  ASSERT_EQ(run("render cornell --integrator light-pure --size 16x16 --spp 4 -o a.exr --json a.json").code, 0);
  ASSERT_EQ(run("render cornell --integrator light-pure --size 16x16 --spp 8 -o b.exr").code, 0);
  const auto statistics = nlohmann::json::parse(slurp(folder_ / "a.json"));
  EXPECT_TRUE(statistics["rmse_estimate"].is_null());
  EXPECT_TRUE(statistics["error"].is_null());
  EXPECT_TRUE(statistics["certificate"]["rmse"].is_null());
  EXPECT_TRUE(statistics["certificate"]["relmse"].is_null());
  const Outcome r = run("compare a.exr b.exr");
  EXPECT_EQ(r.code, 1);
  EXPECT_NE(r.out.find("rmse      n/a"), std::string::npos) << r.out;
  EXPECT_NE(r.err.find("both images are black"), std::string::npos) << r.err;
  EXPECT_TRUE(nlohmann::json::parse(run("compare a.exr b.exr --json").out)["rmse"].is_null());
}

TEST_F(Cli, CompareSaysThatImagesAreEqual) {
  ASSERT_EQ(run("render cornell --size 16x16 --spp 4 -o a.exr").code, 0);
  ASSERT_EQ(run("render cornell --size 16x16 --spp 4 --seed 1 -o b.exr").code, 0);
  EXPECT_NE(run("compare a.exr a.exr").out.find("the images are equal\n"), std::string::npos);
  const Outcome different = run("compare a.exr b.exr");
  EXPECT_EQ(different.out.find("equal"), std::string::npos);
  const size_t bias = different.out.find("\nbias      ");
  ASSERT_NE(bias, std::string::npos) << different.out;
  EXPECT_TRUE(different.out[bias + 11] == '+' || different.out[bias + 11] == '-') << different.out;
}

TEST_F(Cli, InspectCountsEmissiveObjects) {
  const auto j = nlohmann::json::parse(run("inspect cornell --json").out);
  EXPECT_EQ(j["emissive_objects"], 1);
  EXPECT_EQ(j["lights"], 1);
  EXPECT_EQ(j["emissive_triangles"], 2);
  EXPECT_NE(run("inspect cornell").out.find("lights: 1 emissive object (2 triangles)"), std::string::npos);
}

TEST_F(Cli, HeatMapsShowTheRequestedMetric) {
  ASSERT_EQ(run("render cornell --size 24x24 --spp 2 -o a.exr").code, 0);
  ASSERT_EQ(run("render cornell --size 24x24 --spp 2 --seed 1 -o b.exr").code, 0);
  ASSERT_EQ(run("compare a.exr b.exr --heatmap usual.png").code, 0);
  for (const char* kind : {"absolute", "relmse", "signed", "flip"}) {
    const std::string file = std::string(kind) + ".png";
    ASSERT_EQ(run(std::string("compare a.exr b.exr --heatmap-of ") + kind + " --heatmap " + file).code, 0) << kind;
    EXPECT_EQ(slurp(folder_ / file) == slurp(folder_ / "usual.png"), std::string(kind) == "absolute") << kind;
  }
  expect_error("compare a.exr b.exr --heatmap h.png --heatmap-of smell", 2, "flip");
}

TEST_F(Cli, UsageErrorsReturnTwo) {
  expect_error("render cornell", 2, "no output");
  expect_error("render cornell -o a.xyz", 2, ".hdr, .exr, .tif");
  expect_error("render cornell -o a.exr --spp -4", 2, "spp");
  expect_error("render cornell -o a.exr --spp many", 2, "spp");
  expect_error("render cornell -o a.exr --size 10", 2, "WIDTHxHEIGHT");
  expect_error("render cornell -o a.exr --size 10x99999999", 2, "16384x16384");
  expect_error("render cornell -o a.exr --integrator pth", 2, "path-pure");
  expect_error("render cornell -o a.exr --sampler dice", 2, "sobol");
  expect_error("render cornell -o a.exr --set nothing=1", 2, "nearest");
  expect_error("render cornell -o a.exr --set roulette-start=0", 2, "from 1 to 64");
  expect_error("render cornell -o a.exr --set roulette-start", 2, "NAME=VALUE");
  expect_error("render cornell -o a.exr --camera 7", 2, "there is no camera '7'");
  expect_error("render cornell -o a.exr --aov smell", 2, "albedo");
  expect_error("render cornell -o a.exr --paths 'E(DL'", 2, "column 2");
  expect_error("render cornell -o a.exr --paths DL", 2, "begins with E");
  expect_error("render cornell -o a.exr --set film.paths=EQL", 2, "'Q' is not a letter of path expressions");
  expect_error("list furniture", 2, "integrators");
  expect_error("render cornell --frobnicate", 2, "etendue render --help");
  expect_error("render cornell --ssp 4", 2, "did you mean '--spp'?");
  expect_error("render cornell -z", 2, "there is no option '-z'; see etendue render --help");
  expect_error("--ofscreen cornell", 2, "there is no option '--ofscreen'; did you mean '--offscreen'?");
  expect_error("render cornell -o a.exr --integrator pathh", 2, "did you mean 'path'?");
  expect_error("rendr cornell", 2, "did you mean 'render'?");
}

TEST_F(Cli, UnusableInputReturnsThree) {
  expect_error("render missing.glb -o a.exr", 3, "missing.glb: there is no such file");
  expect_error("render . -o a.exr", 3, "folder");
  expect_error("inspect cornel", 3, "did you mean 'cornell'?");
  expect_error("render cornell --env studo -o a.exr", 3, "did you mean 'studio'?");
  expect_error("frobnicate --offscreen --script steps.json", 3, "steps.json");
  std::fclose(std::fopen((folder_ / "empty.glb").c_str(), "wb"));
  expect_error("inspect empty.glb", 3, "empty");
  expect_error("compare empty.glb empty.glb", 3, "empty.glb");
  expect_error("render --like empty.glb -o a.exr", 3, "empty.glb");
  expect_error("render --resume empty.glb -o a.exr", 3, "checkpoint");
  expect_error("render cornell --env empty.glb -o a.exr", 3, "empty.glb");
  EXPECT_FALSE(fs::exists(folder_ / "a.exr"));
}

TEST_F(Cli, UnwritableOutputReturnsFour) {
  expect_error("render cornell --size 8x8 --spp 1 -o nowhere/a.exr", 4, "nowhere");
  fs::create_directory(folder_ / "b.exr");
  expect_error("render cornell --size 8x8 --spp 1 -o b.exr", 4, "folder");
}

TEST_F(Cli, InspectAndListWriteJson) {
  const auto scene = nlohmann::json::parse(run("inspect cornell --json").out);
  for (const char* key :
       {"triangles", "instances", "materials", "lights", "cameras", "unsupported", "warnings", "model"})
    EXPECT_TRUE(scene.contains(key)) << key;
  EXPECT_EQ(scene["model"]["surfaces"]["value"], "diffuse");
  for (const char* kind : {"integrators", "samplers", "materials", "lights", "media", "scenes"}) {
    const auto list = nlohmann::json::parse(run(std::string("list ") + kind + " --json").out);
    ASSERT_TRUE(list.is_array() && !list.empty()) << kind;
    for (const auto& entry : list)
      for (const char* key : {"name", "label", "doc", "parameters"}) EXPECT_TRUE(entry.contains(key)) << kind;
  }
  for (const auto& entry : nlohmann::json::parse(run("list integrators --json").out))
    EXPECT_TRUE(entry.contains("paths") && entry.contains("bias"));
}

TEST_F(Cli, InterruptSavesTheImage) {
  const Outcome r = run("render cornell --size 64x64 --spp 1000000 -o a.exr & sleep 1; kill -INT $!; wait $!");
  EXPECT_EQ(r.code, 130);
  EXPECT_TRUE(fs::exists(folder_ / "a.exr"));
}

TEST_F(Cli, AKilledRenderingResumesToTheSameImage) {
  ASSERT_EQ(run("render cornell --size 128x128 --spp 500 -o whole.exr").code, 0);
  run("render cornell --size 128x128 --spp 500 --checkpoint 0.1 -o cut.exr & sleep 1; kill -9 $!; wait $!");
  // On a machine that finishes within a second there is nothing to resume.
  if (!fs::exists(folder_ / "cut.exr")) {
    ASSERT_TRUE(fs::exists(folder_ / "cut.exr.checkpoint"));
    const Outcome resumed = run("render --resume cut.exr.checkpoint --spp 500 -o cut.exr");
    ASSERT_EQ(resumed.code, 0) << resumed.err;
  }
  EXPECT_EQ(nlohmann::json::parse(run("compare cut.exr whole.exr --json").out)["mse"], 0);
  EXPECT_FALSE(fs::exists(folder_ / "cut.exr.checkpoint"));
}

TEST_F(Cli, VersionIsPrinted) {
  const Outcome version = run("--version");
  EXPECT_EQ(version.code, 0);
  EXPECT_EQ(version.out.find("etendue "), 0u);
}

// The same command with --resume continues; other settings are refused.
TEST_F(Cli, ResumeAcceptsTheSettingsOfTheCheckpoint) {
  const std::string command =
      "render cornell --size 32x32 --integrator bdpt --seed 3 --env sunset --set path.max-depth=7 ";
  run(command + "--spp 1000000 --checkpoint 0.1 -o cut.exr & sleep 1; kill -9 $!; wait $!");
  ASSERT_TRUE(fs::exists(folder_ / "cut.exr.checkpoint"));
  expect_error("render --resume cut.exr.checkpoint --seed 4 -o cut.exr", 2, "render.seed is 3, not 4");
  expect_error("render --resume cut.exr.checkpoint --integrator path -o cut.exr", 2,
               "render.integrator is bdpt, not path");
  expect_error("render glossy-plates --resume cut.exr.checkpoint -o cut.exr", 2, "the scene is cornell");
  expect_error("render --resume cut.exr.checkpoint --env studio -o cut.exr", 2,
               "environment.preset is sunset, not studio");
  ASSERT_TRUE(fs::exists(folder_ / "cut.exr.checkpoint"));
  const Outcome resumed = run(command + "--resume cut.exr.checkpoint --spp 1 -o cut.exr");
  EXPECT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_TRUE(fs::exists(folder_ / "cut.exr"));
}

TEST_F(Cli, StressListsRunsAndWritesCases) {
  const Outcome list = run("stress --list");
  EXPECT_EQ(list.code, 0);
  EXPECT_NE(list.out.find("depth-cut-off"), std::string::npos);
  const Outcome one = run("stress point-light-unseen --json --out matrix");
  EXPECT_EQ(one.code, 0) << one.err;
  const auto json = nlohmann::json::parse(one.out);
  ASSERT_EQ(json.size(), 2U);
  EXPECT_EQ(json[0]["case"], "point-light-unseen");
  EXPECT_EQ(nlohmann::json::parse(slurp(folder_ / "matrix/matrix.json")), json);
  EXPECT_NE(slurp(folder_ / "matrix/matrix.html").find("data:image/png;base64,"), std::string::npos);
  expect_error("stress no-such-case", 2, "no-such-case");
}

}  // namespace
}  // namespace etendue::test::cli_test
