// `etendue advise` and `etendue certify` as used by scripts.
#include <cmath>

#include <nlohmann/json.hpp>

#include "integration/cli/cli.h"

namespace etendue::test::advice_test {
namespace {

class CliAdvice : public Cli {};

TEST_F(CliAdvice, RanksIntegrators) {
  const Outcome r = run("advise cornell --size 24x24 --error 0.05 --pilot 0.02 --json");
  ASSERT_EQ(r.code, 0) << r.err;
  const auto j = nlohmann::json::parse(r.out);
  ASSERT_FALSE(j["methods"].empty());
  for (const auto& method : j["methods"])
    for (const char* key : {"name", "suitable", "reason", "seconds", "seconds_interval", "missing", "missing_share"})
      EXPECT_TRUE(method.contains(key)) << key;
  EXPECT_TRUE(j["methods"][0]["suitable"]);
  EXPECT_FALSE(j["methods"].back()["suitable"]);
  const Outcome text = run("advise cornell --size 24x24 --error 0.05 --pilot 0.02");
  EXPECT_NE(text.out.find("EDD+L"), std::string::npos) << text.out;
}

TEST_F(CliAdvice, RanksForARelativeErrorWithinATime) {
  const Outcome r = run("advise cornell --size 24x24 --error 0.2 --error-measure relative --pilot 60 --time 2 --json");
  ASSERT_EQ(r.code, 0) << r.err;
  const std::string limit = "pilots take at most about ";
  ASSERT_NE(r.err.find(limit), std::string::npos) << r.err;
  EXPECT_LE(std::stod(r.err.substr(r.err.find(limit) + limit.size())), 2.5) << r.err;
  const auto j = nlohmann::json::parse(r.out);
  EXPECT_EQ(j["measure"], "relative");
  ASSERT_FALSE(j["methods"].empty());
  double pilots = 0;
  for (const auto& method : j["methods"])
    if (!method["pilot"].is_null()) pilots += method["pilot"]["seconds"].get<double>();
  EXPECT_GT(pilots, 0);
  EXPECT_LT(pilots, 2.5);
  const Outcome text = run("advise cornell --size 24x24 --error 0.2 --error-measure relative --time 1");
  EXPECT_NE(text.out.find("time to relative error 20 %"), std::string::npos) << text.out;
}

// In a short time the check bounds the error less precisely; it does not refuse.
// The first time that permits a comparison depends on the machine; a confirmation takes ten times as long.
TEST_F(CliAdvice, ShortChecksGiveWeakerStatements) {
  ASSERT_EQ(run("render cornell --size 64x64 --spp 2048 -o a.exr").code, 0);
  nlohmann::json j;
  std::string time;
  for (const char* seconds : {"0.5", "1", "2", "4", "8"}) {
    time = seconds;
    const Outcome r = run("certify a.exr --time " + time + " --json");
    EXPECT_NE(r.err.find("a confirmation takes about"), std::string::npos) << r.err;
    j = nlohmann::json::parse(r.out);
    if (j["verdict"] == "cannot tell") continue;
    EXPECT_EQ(r.code, 0) << r.out;
    break;
  }
  EXPECT_EQ(j["verdict"], "consistent") << time;
  // The stated interval has 95 %; the verdict allows 99.9 %, which is wider by this power.
  constexpr double kWider = 3.29 / 1.96;
  const double stated = j["stated"]["rmse"];
  const auto widened = [&](int end) {
    return stated * std::pow(j["stated"]["rmse_interval"][end].get<double>() / stated, kWider);
  };
  EXPECT_LT(j["rmse_interval"][0].get<double>(), widened(1));
  EXPECT_GT(j["rmse_interval"][1].get<double>(), widened(0));
  EXPECT_GT(j["seconds_wanted"].get<double>(), j["seconds"].get<double>());
}

TEST_F(CliAdvice, ImagesCarryAValidCertificate) {
  const Outcome r = run("render cornell --size 32x32 --spp 64 -o a.exr --json -");
  ASSERT_EQ(r.code, 0) << r.err;
  const auto certificate = nlohmann::json::parse(r.out)["certificate"];
  for (const char* key :
       {"rmse", "rmse_interval", "relmse", "relmse_interval", "bias", "missing", "khat", "rejected", "model"})
    EXPECT_TRUE(certificate.contains(key)) << key;
  const Outcome judged = run("certify a.exr --json");
  EXPECT_EQ(judged.code, 0) << judged.out << judged.err;
  const auto j = nlohmann::json::parse(judged.out);
  EXPECT_EQ(j["verdict"], "stands");
  EXPECT_EQ(j["stated"], certificate);
  EXPECT_TRUE(run("certify a.exr").out.starts_with("stands: true RMSE "));
}

// The pixels of one rendering with the certificate of another: --like renders the latter again with truncated paths.
TEST_F(CliAdvice, CertificateStatesTruncatedPaths) {
  ASSERT_EQ(run("render cornell --size 32x32 --spp 64 --max-depth 2 -o b.exr --json b.json").code, 0);
  const auto j = nlohmann::json::parse(slurp(folder_ / "b.json"));
  EXPECT_EQ(j["certificate"]["bias"], "biased");
  EXPECT_EQ(j["certificate"]["missing"][0]["paths"], "EDD+L");
  EXPECT_EQ(run("certify b.exr").code, 0);
}

TEST_F(CliAdvice, ErrorsAreOneLine) {
  expect_error("advise cornell", 2, "error");
  expect_error("advise cornell --error 0", 2, "error");
  expect_error("advise missing.glb --error 1", 3, "missing.glb");
  expect_error("certify missing.exr", 3, "missing.exr");
  ASSERT_EQ(run("render cornell --size 8x8 --spp 2 -o a.png").code, 0);
  expect_error("certify a.png", 3, "a.png");
}

}  // namespace
}  // namespace etendue::test::advice_test
