// `etendue bench` as used by scripts: output files, stored references, one-line errors.
#include <nlohmann/json.hpp>
#include <sstream>

#include "integration/cli/cli.h"

namespace etendue::test::bench_test {
namespace {

class CliBench : public Cli {
 protected:
  // Each test has its own cache folder.
  void SetUp() override {
    Cli::SetUp();
    ::setenv("XDG_CACHE_HOME", (folder_ / "cache").c_str(), 1);
  }

  nlohmann::json summary(const std::string& folder) const {
    return nlohmann::json::parse(slurp(folder_ / folder / "summary.json"));
  }

  size_t cached() const {
    const fs::path references = folder_ / "cache" / "etendue" / "references";
    return fs::exists(references)
               ? static_cast<size_t>(std::distance(fs::directory_iterator(references), fs::directory_iterator()))
               : 0;
  }
};

TEST_F(CliBench, WritesItsFiles) {
  const Outcome r =
      run("bench cornell --size 16x16 --methods path:sampler=sobol,path-pure:sampler=random "
          "--budget 0.05 --repeats 2 --out b");
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_TRUE(r.out.empty()) << r.out;
  for (const char* file : {"curves.csv", "summary.json", "chart.svg", "chart.png", "report.html", "reference.exr"})
    EXPECT_TRUE(fs::exists(folder_ / "b" / file)) << file;
  const auto j = summary("b");
  for (const char* key : {"scene", "reference", "methods"}) EXPECT_TRUE(j.contains(key)) << key;
  EXPECT_GT(j["reference"]["standard_error"], 0);
  EXPECT_TRUE(fs::exists(folder_ / j["reference"]["file"].get<std::string>()));
  ASSERT_EQ(j["methods"].size(), 2u);
  EXPECT_EQ(j["methods"][0]["name"], "path:sampler=sobol");
  for (const auto& method : j["methods"])
    for (const char* key : {"name", "slope", "slope_stderr", "efficiency", "bias", "khat", "rays_per_second"})
      EXPECT_TRUE(method.contains(key)) << key;
}

TEST_F(CliBench, CurvesAreWrittenAsATable) {
  ASSERT_EQ(run("bench cornell --size 16x16 --methods path,path-pure --samples 8 --repeats 3 --out b").code, 0);
  std::istringstream csv(slurp(folder_ / "b" / "curves.csv"));
  std::string line;
  std::getline(csv, line);
  EXPECT_EQ(line, "method,repeat,seconds,spp,mse,relmse,bias,displayed_mse");
  size_t rows = 0;
  for (; std::getline(csv, line); ++rows) EXPECT_EQ(std::ranges::count(line, ','), 7) << line;
  EXPECT_EQ(rows, 2u * 3 * 6);  // two methods, three repeats, at 1, 2, 3, 4, 6 and 8 samples
}

// The program itself is the other renderer, with a seed of its own.
TEST_F(CliBench, OtherRenderersAreMeasured) {
  const std::string renderer = " render cornell --size {width}x{height} --spp {spp} --seed 7 -o {out}";
  const Outcome r = run("bench cornell --size 16x16 --samples 16 --repeats 1 --out b --methods 'path,external:\"" +
                        std::string(ETENDUE_BINARY) + renderer + " # {seed}\"'");
  ASSERT_EQ(r.code, 0) << r.err;
  const auto method = summary("b")["methods"][1];
  EXPECT_EQ(method["name"], "etendue");
  EXPECT_EQ(method["spp"], 16);
  EXPECT_GE(method["startup_seconds"].get<double>(), 0);
  EXPECT_TRUE(method["rays_per_second"].is_null());
  EXPECT_TRUE(summary("b")["methods"][0]["startup_seconds"].is_null());

  ASSERT_EQ(run("render cornell --size 16x16 --spp 16 --seed 7 -o same.exr").code, 0);
  const auto compared = nlohmann::json::parse(run("compare same.exr b/reference.exr --json").out);
  std::istringstream csv(slurp(folder_ / "b" / "curves.csv"));
  std::string line, last;
  while (std::getline(csv, line)) last = line;
  double mse = 0;
  ASSERT_EQ(std::sscanf(last.c_str(), "etendue,0,%*f,16,%lf", &mse), 1) << last;
  EXPECT_NEAR(mse, compared["mse"].get<double>(), 1e-6 * mse);
}

TEST_F(CliBench, FailureOfAnotherRendererIsReported) {
  const Outcome r =
      run("bench cornell --size 16x16 --samples 4 --repeats 1 --out b "
          "--methods 'path,external:\"echo no scene >&2; exit 3 # {spp} {seed} {out}\"'");
  EXPECT_EQ(r.code, 0);
  EXPECT_NE(r.err.find("not measured: the program ended with exit code 3: no scene"), std::string::npos) << r.err;
  EXPECT_EQ(summary("b")["methods"].size(), 2u);
}

TEST_F(CliBench, ChartsShowTheChosenMeasure) {
  const std::string bench = "bench cornell --size 16x16 --methods path,path-pure --samples 8 --repeats 2 ";
  ASSERT_EQ(run(bench + "--error-measure displayed --out b").code, 0);
  EXPECT_NE(slurp(folder_ / "b" / "chart.svg").find(">displayed error</text>"), std::string::npos);
  EXPECT_NE(slurp(folder_ / "b" / "report.html").find("--error-measure displayed"), std::string::npos);
  const auto methods = summary("b")["methods"];
  for (const auto& method : methods) {
    EXPECT_GT(method["displayed"].get<double>(), 0);
    EXPECT_LT(method["displayed"].get<double>(), 1);
  }
  expect_error(bench + "--error-measure feeling --out c", 2, "displayed");
}

// With a time budget one of the unbiased methods renders the reference. Which one depends on the speed of the machine.
TEST_F(CliBench, TheReferenceIsRenderedByAnUnbiasedMethod) {
  const Outcome r = run("bench glass-caustic --size 48x36 --methods path,bdpt,sppm --budget 1 --repeats 1 --out b");
  ASSERT_EQ(r.code, 0) << r.err;
  const std::string reference = summary("b")["reference"]["integrator"];
  EXPECT_TRUE(reference == "path" || reference == "bdpt") << reference;
  ASSERT_EQ(run("bench cornell --size 16x16 --methods path,bdpt --samples 4 --repeats 1 --out c").code, 0);
  EXPECT_EQ(summary("c")["reference"]["integrator"], "path");
}

// Light tracing alone cannot reach a pinhole camera: its black image has no error.
TEST_F(CliBench, MethodsThatCannotRenderTheSceneHaveNoError) {
  const Outcome r = run("bench cornell --size 16x16 --methods path,light-pure --samples 8 --repeats 2 --out b");
  EXPECT_EQ(r.code, 0);
  EXPECT_NE(r.err.find("light-pure: not measured"), std::string::npos) << r.err;
  const auto methods = summary("b")["methods"];
  EXPECT_GT(methods[0]["rmse"].get<double>(), 0);
  for (const char* key : {"rmse", "relmse", "displayed"}) EXPECT_TRUE(methods[1][key].is_null()) << key;
}

TEST_F(CliBench, ReportIsSelfContained) {
  ASSERT_EQ(run("bench cornell --size 16x16 --methods path,path-pure --samples 4 --repeats 1 --out b").code, 0);
  const std::string page = slurp(folder_ / "b" / "report.html");
  for (const char* part : {"<svg", "path-pure", "data:image/png;base64,", "iVBORw0KGgo", "type=\"range\"", "</html>"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  for (const char* part : {"src=\"http", "href=", "@import", "url("})
    EXPECT_EQ(page.find(part), std::string::npos) << part;
}

// The errors without the times, which are not reproducible.
std::string errors_of(const std::string& csv) {
  std::istringstream lines(csv);
  std::string line, kept;
  while (std::getline(lines, line)) {
    std::istringstream fields(line);
    std::string field;
    for (int column = 0; std::getline(fields, field, ','); ++column)
      if (column != 2) kept += field + ",";
    kept += "\n";
  }
  return kept;
}

TEST_F(CliBench, ReportHasTheReproductionCommand) {
  ASSERT_EQ(run("bench cornell --size 16x16 --methods path:sampler=random,path-pure --samples 4 --repeats 2 --seed 5 "
                "--set material.0.metallic=0.5 --set film.filter=box --set model.media=on --out first")
                .code,
            0);
  const std::string page = slurp(folder_ / "first" / "report.html");
  const size_t from = page.find("etendue bench ") + 8, to = page.find("</pre>", from);
  const std::string command = page.substr(from, to - from);
  ASSERT_EQ(run(command).code, 0) << command;
  EXPECT_EQ(errors_of(slurp(folder_ / "bench" / "curves.csv")), errors_of(slurp(folder_ / "first" / "curves.csv")));
}

TEST_F(CliBench, ReferenceIsStoredAndExtended) {
  const std::string bench = "bench cornell --size 16x16 --methods path --repeats 1 ";
  ASSERT_EQ(run(bench + "--samples 8 --out a").code, 0);
  EXPECT_EQ(cached(), 1u);
  EXPECT_EQ(summary("a")["reference"]["spp"], 8);
  ASSERT_EQ(run(bench + "--samples 4 --out b").code, 0);
  EXPECT_EQ(summary("b")["reference"]["spp"], 8);
  ASSERT_EQ(run(bench + "--samples 24 --out c").code, 0);
  EXPECT_EQ(summary("c")["reference"]["spp"], 24);
  EXPECT_EQ(cached(), 1u);
  ASSERT_EQ(run(bench + "--samples 24 --no-cache --out d").code, 0);
  EXPECT_EQ(nlohmann::json::parse(run("compare c/reference.exr d/reference.exr --json").out)["mse"], 0);
  ASSERT_EQ(run(bench + "--samples 4 --set material.0.metallic=1 --out e").code, 0);
  EXPECT_EQ(cached(), 2u);
}

TEST_F(CliBench, ReferenceMayBeAFile) {
  ASSERT_EQ(run("render cornell --size 16x16 --spp 64 --seed 9 -o r.exr").code, 0);
  ASSERT_EQ(run("render cornell --size 16x16 --spp 64 --seed 9 -o r.hdr").code, 0);
  ASSERT_EQ(run("bench cornell --size 16x16 --methods path --samples 4 --repeats 2 --reference r.exr --out b").code, 0);
  EXPECT_EQ(summary("b")["reference"]["file"], "r.exr");
  EXPECT_GT(summary("b")["reference"]["standard_error"], 0);
  EXPECT_EQ(cached(), 0u);
  const Outcome r = run("bench cornell --size 16x16 --methods path --samples 4 --reference r.hdr --out c");
  EXPECT_EQ(r.code, 0);
  EXPECT_NE(r.err.find("error of the reference is unknown"), std::string::npos) << r.err;
  EXPECT_TRUE(summary("c")["reference"]["standard_error"].is_null());
}

TEST_F(CliBench, ReferenceMayBeLarger) {
  ASSERT_EQ(run("render cornell --size 32x32 --spp 64 --seed 9 -o r.exr").code, 0);
  ASSERT_EQ(run("bench cornell --size 16x16 --methods path --samples 4 --reference r.exr --out b").code, 0);
  EXPECT_EQ(summary("b")["width"], 16);
  EXPECT_GT(summary("b")["reference"]["standard_error"], 0);
  ASSERT_EQ(run("bench cornell --methods path --samples 4 --reference r.exr --out c").code, 0);
  EXPECT_EQ(summary("c")["width"], 32);
  // The mean of four pixels has half the standard error.
  EXPECT_NEAR(summary("b")["reference"]["standard_error"].get<double>(),
              summary("c")["reference"]["standard_error"].get<double>() / 2, 1e-6);
}

TEST_F(CliBench, ErrorsAreOneLine) {
  const std::string some = "bench cornell --size 8x8 --samples 1 --out b --methods ";
  expect_error("bench cornell --methods path --out b", 2, "--budget SECONDS");
  expect_error("bench cornell --methods path --budget 1", 2, "out");
  expect_error("bench cornell --methods path --budget -1 --out b", 2, "budget");
  expect_error(some + "pth", 2, "path-pure");
  expect_error(some + "path:sampler=dice", 2, "sobol");
  expect_error(some + "path:flavour=1", 2, "there is no parameter 'flavour'");
  expect_error(some + "path:max-depth", 2, "name=value");
  expect_error(some + "path,path", 2, "twice");
  expect_error(some + ",", 2, "the list is empty");
  expect_error(some + "path:film.width=9", 2, "--set");
  expect_error(some + "path --reference missing.exr", 3, "missing.exr");
  ASSERT_EQ(run("render cornell --size 9x8 --spp 1 -o r.exr").code, 0);
  expect_error(some + "path --reference r.exr", 3, "9x8");
  std::fclose(std::fopen((folder_ / "file").c_str(), "wb"));
  expect_error("bench cornell --size 8x8 --samples 1 --out file --methods path", 4, "folder");
  EXPECT_FALSE(fs::exists(folder_ / "b"));
}

TEST_F(CliBench, InterruptKeepsCompleteRepeats) {
  // Interrupted after the first repeats, whenever they are complete.
  const std::string progress = (folder_ / "progress.txt").string();
  const Outcome r =
      run("bench cornell --size 32x32 --methods path --budget 0.2 --repeats 1000 --reference-time 0.2 --out b 2> " +
          progress + " & for i in $(seq 600); do grep -q 'repeat [2-9]' " + progress +
          " && break; sleep 0.1; done; kill -INT $!; wait $!");
  EXPECT_EQ(r.code, 130);
  EXPECT_EQ(summary("b")["interrupted"], true);
  EXPECT_FALSE(summary("b")["methods"][0]["slope"].is_null());
}

}  // namespace
}  // namespace etendue::test::bench_test
