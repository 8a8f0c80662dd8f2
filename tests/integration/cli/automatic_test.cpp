// `etendue render --integrator auto` as used by scripts.
#include <nlohmann/json.hpp>

#include "image/image.h"
#include "integration/cli/cli.h"
#include "render/image_output.h"

namespace etendue::test::automatic_test {
namespace {

using nlohmann::json;

class CliAutomatic : public Cli {
 protected:
  json statistics(const std::string& arguments) const {
    const Outcome r = run("render " + arguments + " --json -");
    EXPECT_EQ(r.code, 0) << r.err;
    return r.code == 0 ? json::parse(r.out) : json::object();
  }
  json state_of(const std::string& file) const {
    const auto image = image::read_exr((folder_ / file).string());
    return image ? json::parse(image->attributes.at(render::kStateAttribute)) : json();
  }
};

TEST_F(CliAutomatic, RecordsTheChoice) {
  const std::string command = "glass-caustic --paths 'EDS*L' --size 48x48 --spp 8 --integrator auto -o ";
  const json j = statistics(command + "a.exr");
  EXPECT_EQ(j["integrator"], "bdpt");
  EXPECT_EQ(j["spp"], 8);
  EXPECT_EQ(j["automatic"]["integrator"], "bdpt");
  EXPECT_EQ(j["automatic"]["cost_unit"], "rays");
  const std::string reason = j["automatic"]["reason"];
  EXPECT_FALSE(reason.empty());
  const json state = state_of("a.exr");
  EXPECT_EQ(state["settings"]["render.integrator"], "auto");
  EXPECT_EQ(state["automatic"]["integrator"], "bdpt");
  EXPECT_EQ(state["automatic"]["reason"], reason);
  // The chosen integrator gives the same image.
  ASSERT_EQ(run("render glass-caustic --paths 'EDS*L' --size 48x48 --spp 8 --integrator bdpt --sampler " +
                j["sampler"].get<std::string>() + " -o b.exr")
                .code,
            0);
  const Outcome same = run("compare a.exr b.exr --json");
  EXPECT_EQ(json::parse(same.out)["mse"], 0) << same.out;
  // The same settings render with the same method, without a new choice.
  const json again = statistics("--like a.exr -o c.exr");
  EXPECT_EQ(again["integrator"], "bdpt");
  EXPECT_TRUE(again["automatic"].is_null());
}

TEST_F(CliAutomatic, SettingsOfTheChoice) {
  const json j = statistics(
      "cornell --size 16x16 --spp 4 --integrator auto --set auto.allow=consistent "
      "--set auto.error=displayed -o a.exr");
  EXPECT_EQ(j["automatic"]["error"], "displayed");
  for (const auto& m : j["automatic"]["methods"])
    EXPECT_EQ(m["refusal"].is_null(), m["name"] == "sppm" || m.contains("spp"));
  EXPECT_TRUE(statistics("cornell --size 16x16 --spp 4 -o b.exr")["automatic"].is_null());
}

TEST_F(CliAutomatic, WrongUseIsExplained) {
  expect_error("render cornell --integrator auto --set auto.allow=all -o a.exr", 2, "unbiased, consistent, anything");
  expect_error("render cornell --integrator auto --set auto.error=psnr -o a.exr", 2, "rmse, relative, displayed");
  expect_error("advise cornell --error 0.1 --set render.integrator=auto", 2, "etendue advise");
  expect_error("bench cornell --methods path,auto:allow=all --samples 2 -o b", 2, "unbiased, consistent, anything");
}

// The time of the pilots is part of the curve. With a number of samples the choice is that of `render`.
TEST_F(CliAutomatic, IsAMethodOfABenchmark) {
  const Outcome r =
      run("bench glass-caustic --set 'film.paths=EDS*L' --size 32x32 --methods "
          "'path,auto,auto:allow=consistent:error=rmse' "
          "--samples 4 --reference-samples 16 --repeats 2 --no-cache -o b");
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_NE(r.err.find("has the smallest predicted relative error"), std::string::npos) << r.err;
  const json summary = json::parse(slurp(folder_ / "b/summary.json"));
  ASSERT_EQ(summary["methods"].size(), 3u);
  EXPECT_TRUE(summary["methods"][0]["choices"].empty());
  const json& automatic = summary["methods"][1];
  ASSERT_EQ(automatic["choices"].size(), 2u);
  EXPECT_EQ(automatic["spp"], 4);
  EXPECT_NE(summary["methods"][2]["choices"][0].get<std::string>().find("RMSE"), std::string::npos);
  // Four samples of an image this small take milliseconds, the choice at least a million samples of a pixel.
  EXPECT_GT(automatic["seconds"].get<double>(), 10 * summary["methods"][0]["seconds"].get<double>());
}

// A checkpoint stores the chosen method; the rendering continues with it.
TEST_F(CliAutomatic, ResumedRenderingsKeepTheMethod) {
  const std::string command =
      "glass-caustic --paths 'EDS*L' --size 16x16 --integrator auto --checkpoint 0.1 -o cut.exr ";
  const std::string checkpoint = (folder_ / "cut.exr.checkpoint").string();
  run("render " + command + "--spp 100000 & for i in $(seq 600); do [ -e " + checkpoint +
      " ] && break; sleep 0.1; done; "
      "kill -9 $!; wait $!");
  ASSERT_TRUE(fs::exists(checkpoint));
  expect_error("render --resume cut.exr.checkpoint --integrator path -o cut.exr", 2,
               "render.integrator is auto, not path");
  const json resumed = statistics(command + "--resume cut.exr.checkpoint --spp 1");
  EXPECT_EQ(resumed["integrator"], "bdpt");
  EXPECT_TRUE(resumed["automatic"].is_null());
  EXPECT_EQ(state_of("cut.exr")["automatic"]["integrator"], "bdpt");
}

}  // namespace
}  // namespace etendue::test::automatic_test
