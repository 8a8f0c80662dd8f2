// `etendue probe`: light meters on the command line.
#include <fstream>
#include <nlohmann/json.hpp>

#include "integration/cli/cli.h"

namespace etendue::test::probe_test {
namespace {

using nlohmann::json;

TEST_F(Cli, ProbeMeasuresInPhotometricAndRadiometricUnits) {
  const Outcome r = run("probe cornell --size 64x64 --at 32 61 --spp 64 --efficacy maximal --json");
  ASSERT_EQ(r.code, 0) << r.err;
  const auto j = json::parse(r.out);
  EXPECT_GT(j["irradiance"]["value"][0].get<double>(), 0);
  EXPECT_NEAR(j["normal"][1].get<double>(), 1, 1e-3);
  const auto& e = j["irradiance"];
  const double y = 0.212671 * e["value"][0].get<double>() + 0.71516 * e["value"][1].get<double>() +
                   0.072169 * e["value"][2].get<double>();
  EXPECT_NEAR(e["photometric"].get<double>(), y, 1e-4 * y);
  EXPECT_NEAR(683 * e["radiometric"].get<double>(), y, 1e-4 * y);
}

// A white plate under a point light of 100 cd at a distance of 2 m.
constexpr const char* kPlate = R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 2]}],
    "extensionsUsed": ["KHR_lights_punctual"],
    "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 100}]}},
    "nodes": [{"mesh": 0}, {"translation": [0, 2, 0], "extensions": {"KHR_lights_punctual": {"light": 0}}},
              {"camera": 0, "translation": [0, 4, 0.01], "rotation": [-0.70710678, 0, 0, 0.70710678]}],
    "cameras": [{"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.01}}],
    "materials": [{"pbrMetallicRoughness": {"metallicFactor": 0}}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
    "buffers": [{"byteLength": 60, "uri": "data:application/octet-stream;base64,AACAwAAAAAAAAIDAAACAQAAAAAAAAIDAAACAQAAAAAAAAIBAAACAwAAAAAAAAIBAAAACAAEAAAADAAIA"}],
    "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-4, 0, -4], "max": [4, 0, 4]},
                  {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}]})";

// An intensity of 100 in KHR_lights_punctual is 100 cd. Below it, at a distance of 2 m, the illuminance is 25 lx.
TEST_F(Cli, ProbeReadsTheCandelasOfAFile) {
  std::ofstream(folder_ / "plate.gltf") << kPlate;
  const Outcome r = run("probe plate.gltf --size 64x64 --spp 64 --json");
  ASSERT_EQ(r.code, 0) << r.err;
  const auto j = json::parse(r.out);
  EXPECT_NEAR(j["irradiance"]["photometric"].get<double>(), 25, 0.02);
  EXPECT_NEAR(j["irradiance"]["radiometric"].get<double>(), 25 / 146.162, 2e-4);
}

// The luminous efficacy of a scene without colour is that of D65 between 380 and 780 nm, and the luminance that of the
// spectrum.
TEST_F(Cli, ProbeMeasuresTheSpectrum) {
  std::ofstream(folder_ / "plate.gltf") << kPlate;
  const Outcome r = run("probe plate.gltf --size 64x64 --spp 64 --spectrum --json");
  ASSERT_EQ(r.code, 0) << r.err;
  const auto j = json::parse(r.out);
  const auto& spectrum = j["spectrum"];
  ASSERT_EQ(spectrum["samples"].size(), 80U);
  EXPECT_EQ(spectrum["samples"][0]["wavelength"], 382.5);
  const double luminance = j["radiance"]["photometric"];
  EXPECT_NEAR(spectrum["luminance"].get<double>() / luminance, 1, 0.02);
  const Outcome d65 = run("spectrum d65 --json");
  const double efficacy = json::parse(d65.out)["luminous_efficacy"];
  EXPECT_NEAR(j["radiance"]["lumens_per_watt"].get<double>() / efficacy, 1, 0.01);
  EXPECT_NE(run("probe plate.gltf --size 64x64 --spp 16 --spectrum").out.find("wavelength, nm"), std::string::npos);
}

TEST_F(Cli, ProbeReportsErrors) {
  expect_error("probe cornell --at 900000 1", 2, "outside");
  expect_error("probe cornell --efficacy candles", 2, "equal-energy");
  expect_error("probe nowhere.glb", 3, "nowhere.glb");
}

}  // namespace
}  // namespace etendue::test::probe_test
