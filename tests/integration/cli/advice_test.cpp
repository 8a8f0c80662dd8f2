// `etendue advise` and `etendue certify` as used by scripts.
#include <nlohmann/json.hpp>

#include "integration/cli/cli.h"

namespace etendue::test {
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
}  // namespace etendue::test
