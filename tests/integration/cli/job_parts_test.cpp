// Parts of bench, stress and figure --all: merged to the results of one run, and refused where they do not belong
// together.
#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "image/image.h"
#include "integration/cli/cli.h"

namespace etendue::test::job_parts_test {
namespace {

using nlohmann::json;

class JobParts : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    ::setenv("XDG_CACHE_HOME", (folder_ / "cache").c_str(), 1);
  }
  // Computes all parts and returns their names, the last first.
  std::string compute(const std::string& command, int parts, const std::string& folder) const {
    std::string names;
    for (int i = 1; i <= parts; ++i) {
      const std::string part = std::to_string(i) + "/" + std::to_string(parts);
      const Outcome r = run(command + " --part " + part + " --out " + folder);
      EXPECT_EQ(r.code, 0) << r.err;
      names.insert(0, folder + "/" + name_of(i, parts) + " ");
    }
    return names;
  }
  static std::string name_of(int part, int parts) {
    return "part-" + std::to_string(part) + "-of-" + std::to_string(parts) + ".part";
  }
  void expect_same_file(const std::string& a, const std::string& b, const std::string& name) const {
    const std::string content = slurp(folder_ / a / name);
    EXPECT_FALSE(content.empty()) << name;
    EXPECT_TRUE(content == slurp(folder_ / b / name)) << name << " of " << b;
  }
  // A merge that is refused leaves an existing result as it is.
  void expect_refused(const std::string& parts, int code, const std::string& message) const {
    fs::create_directories(folder_ / "kept");
    const char* results[] = {"matrix.json", "curves.csv", "contact-sheet.png"};
    for (const char* name : results) std::ofstream(folder_ / "kept" / name) << "kept";
    expect_error("merge " + parts + " -o kept", code, message);
    for (const char* name : results) EXPECT_EQ(slurp(folder_ / "kept" / name), "kept") << parts;
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "kept"), fs::directory_iterator()), 3) << parts;
  }
};

// The table without the times.
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

// The summary without what depends on times.
json errors_of(json summary) {
  summary["reference"].erase("seconds");
  summary["reference"].erase("file");
  for (json& method : summary["methods"])
    for (const char* key : {"slope", "slope_stderr", "efficiency", "efficiency_stderr", "seconds", "rays_per_second"})
      method.erase(key);
  return summary;
}

// Two methods and three repeats: two parts, parts that divide a repeat, and parts without any work.
TEST_F(JobParts, BenchHasTheErrorsOfOneRun) {
  const std::string command =
      "bench cornell --size 20x16 --methods path:sampler=random,bdpt --samples 6 --repeats 3 --seed 4 "
      "--set material.0.metallic=0.5";
  ASSERT_EQ(run(command + " --out one").code, 0);
  for (const int parts : {1, 2, 4, 8}) {
    const std::string folder = "parts" + std::to_string(parts), merged = "merged" + std::to_string(parts);
    const Outcome r = run("merge " + compute(command, parts, folder) + "-o " + merged);
    ASSERT_EQ(r.code, 0) << r.err;
    EXPECT_EQ(errors_of(slurp(folder_ / "one/curves.csv")), errors_of(slurp(folder_ / merged / "curves.csv")));
    EXPECT_EQ(errors_of(json::parse(slurp(folder_ / "one/summary.json"))),
              errors_of(json::parse(slurp(folder_ / merged / "summary.json"))));
    for (const char* image :
         {"reference.png", "method-1.png", "method-2.png", "method-2-error.png", "method-1-flip.png"})
      expect_same_file("one", merged, image);
    EXPECT_EQ(image::read_exr(folder_ / "one/reference.exr")->layers[0].pixels,
              image::read_exr(folder_ / merged / "reference.exr")->layers[0].pixels);
    const std::string one = slurp(folder_ / "one/report.html"), page = slurp(folder_ / merged / "report.html");
    const auto command_of = [](const std::string& text) {
      const size_t from = text.find("<pre id=\"command\">");
      return text.substr(from, text.find("</pre>", from) - from);
    };
    EXPECT_EQ(command_of(page), command_of(one));
  }
}

// The reference is a file, a method cannot render the scene, and another renderer fails in its second repeat only.
TEST_F(JobParts, BenchMergesMethodsThatAreNotMeasured) {
  ASSERT_EQ(run("render cornell --size 16x16 --spp 32 --seed 9 -o r.exr").code, 0);
  const std::string renderer = std::string(ETENDUE_BINARY) +
                               " render cornell --size {width}x{height} --spp {spp} --seed 7 -o {out}; "
                               "test {seed} -lt ";
  const std::string command = "bench cornell --methods 'path,light-pure,external:\"" + renderer +
                              "1\"' --samples 2 --repeats 2 --reference r.exr";
  ASSERT_EQ(run(command + " --out one").code, 0);
  const Outcome r = run("merge " + compute(command, 2, "parts") + "-o merged");
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_NE(r.err.find("light-pure: not measured"), std::string::npos) << r.err;
  EXPECT_NE(r.err.find("etendue: not measured: the program ended with exit code 1"), std::string::npos) << r.err;
  EXPECT_EQ(errors_of(slurp(folder_ / "one/curves.csv")), errors_of(slurp(folder_ / "merged/curves.csv")));
  const auto one = json::parse(slurp(folder_ / "one/summary.json")),
             merged = json::parse(slurp(folder_ / "merged/summary.json"));
  EXPECT_EQ(errors_of(one), errors_of(merged));
  EXPECT_EQ(merged["reference"]["file"], "r.exr");
}

TEST_F(JobParts, StressHasTheMatrixOfOneRun) {
  const std::string command = "stress lens-of-no-size point-light-unseen index-of-one --size 8";
  const Outcome one = run(command + " --out one");
  ASSERT_NE(one.code, 2) << one.err;
  for (const int parts : {2, 5}) {
    const std::string folder = "parts" + std::to_string(parts), merged = "merged" + std::to_string(parts);
    const Outcome r = run("merge " + compute(command, parts, folder) + "-o " + merged);
    EXPECT_EQ(r.code, one.code) << r.err;
    expect_same_file("one", merged, "matrix.json");
    expect_same_file("one", merged, "matrix.html");
    const auto last_line = [](const std::string& text) { return text.substr(text.rfind('\n', text.size() - 2)); };
    EXPECT_EQ(last_line(r.out), last_line(one.out));
  }
}

TEST_F(JobParts, FiguresHaveTheContactSheetOfOneRun) {
  const std::string command = "figure --all --width 32 --effort 0.01";
  const Outcome one = run(command + " --out one");
  ASSERT_EQ(one.code, 0) << one.err;
  size_t made = 0;
  for (const json& entry : json::parse(run("figure --json").out))
    if (entry["made"] == true) {
      ++made;
      const auto file = folder_ / "one" / ("figure-" + entry["number"].get<std::string>() + ".png");
      EXPECT_GT(slurp(file).size(), 500U) << file;
    }
  EXPECT_GE(made, 126U);
  EXPECT_GT(slurp(folder_ / "one/contact-sheet.png").size(), 10000U);
  const Outcome r = run("merge " + compute(command, 3, "parts") + "-o merged");
  ASSERT_EQ(r.code, 0) << r.err;
  size_t files = 0;
  for (const auto& entry : fs::directory_iterator(folder_ / "one")) {
    expect_same_file("one", "merged", entry.path().filename().string());
    ++files;
  }
  EXPECT_GT(files, 100U);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "merged"), fs::directory_iterator()),
            static_cast<std::ptrdiff_t>(files));
}

TEST_F(JobParts, MissingDoubleAndForeignPartsAreNamed) {
  const std::string command = "stress point-light-unseen index-of-one --size 8";
  compute(command, 5, "p");
  const auto part = [](int i) { return "p/" + name_of(i, 5) + " "; };
  expect_refused(part(1) + part(4) + part(2), 3, "merge: missing: part 3, 5 of 5");
  expect_refused(part(2), 3, "merge: missing: part 1, 3, 4 and 1 more of 5");
  expect_refused(part(1) + part(2) + part(1), 3, "is part 1 of 5, as p/part-1-of-5.part; give each part once");
  compute(command, 2, "q");
  expect_refused(part(1) + "q/" + name_of(2, 2), 3, "it is part 2 of 2, not of 5");
  compute(command + " --seed 3", 2, "seed");
  expect_refused("q/" + name_of(1, 2) + " seed/" + name_of(2, 2), 3, "--seed is 3, not 0");
  compute("stress point-light-unseen --size 8", 2, "cases");
  expect_refused("q/" + name_of(1, 2) + " cases/" + name_of(2, 2), 3, "the list of cases is point-light-unseen, not");

  const std::string bench = "bench cornell --size 8x8 --methods path --samples 2 --repeats 2 --no-cache";
  compute(bench, 2, "b");
  expect_refused("q/" + name_of(1, 2) + " b/" + name_of(2, 2), 3, "it is a part of bench, not of stress");
  compute(bench + " --set material.0.metallic=1", 2, "m");
  expect_refused("b/" + name_of(1, 2) + " m/" + name_of(2, 2), 3, "the hash of the scene and its settings is");
  compute(bench + " --reference-samples 5", 2, "r");
  expect_refused("b/" + name_of(1, 2) + " r/" + name_of(2, 2), 3, "the number of samples of the reference is 5, not 4");
}

TEST_F(JobParts, DamagedPartsAreRefused) {
  compute("stress point-light-unseen --size 8", 2, "p");
  const std::string a = "p/" + name_of(1, 2) + " ", b = "p/" + name_of(2, 2);
  const std::string bytes = slurp(folder_ / b);
  const auto write_changed = [&](std::string content) {
    std::ofstream(folder_ / "changed.part", std::ios::binary) << content;
  };
  for (const double length : {0.3, 0.6, 0.99}) {
    write_changed(bytes.substr(0, static_cast<size_t>(length * static_cast<double>(bytes.size()))));
    expect_refused(a + "changed.part", 3, "changed.part: it is damaged; compute this part again");
  }
  for (const size_t position : {size_t{20}, bytes.size() / 2, bytes.size() - 1}) {
    std::string changed = bytes;
    changed[position] = static_cast<char>(changed[position] ^ 1);
    write_changed(changed);
    expect_refused(a + "changed.part", 3, "changed.part: it is damaged");
  }
  std::ofstream(folder_ / "text.part") << "no part";
  expect_refused(a + "text.part", 3, "text.part: is not a part");
  expect_refused(a + "missing.part", 3, "missing.part");
  expect_error("merge " + a + b + " -o kept --png a.png", 2, "is not a part of a rendering");
}

TEST_F(JobParts, WrongArgumentsAreRefused) {
  for (const char* text : {"0/2", "3/2", "2", "a/b", "1/2/3", "-1/2", "1/9999999"})
    expect_error("stress --part " + std::string(text) + " --out p", 2, "is not a part; give K/N");
  expect_error("stress --part 1/2", 2, "give a folder");
  expect_error("stress --part 1/2 --out p --json", 2, "a part has no --json");
  expect_error("figure --part 1/2 --out p", 2, "--part divides --all");
  expect_error("figure --all --part 1/2", 2, "give a folder");
  const std::string bench = "bench cornell --size 8x8 --methods path --out p --part 1/2 ";
  expect_error(bench + "--budget 1", 2, "give --reference FILE or --reference-samples N");
  expect_error(bench + "--samples 1 --reference-time 1", 2, "give --reference FILE or --reference-samples N");
  EXPECT_FALSE(fs::exists(folder_ / "p"));
  // A part that exists is kept.
  const std::string stress = "stress point-light-unseen --size 8 --part 1/2 --out p";
  ASSERT_EQ(run(stress).code, 0);
  expect_error(stress, 4, "p/part-1-of-2.part: exists already; delete it to compute this part again");
}

// The scripts for job arrays, with a scheduler that runs commands on this machine.
TEST_F(JobParts, JobArrayComputesAndMerges) {
  std::ofstream(folder_ / "sbatch") << R"(#!/usr/bin/env bash
last=none
while [ $# -gt 0 ]; do
  case $1 in
    --array=1-*) last=${1#--array=1-} ;;
    --dependency=afterok:17 | --kill-on-invalid-dep=yes | --parsable | --cpus-per-task=1) ;;
    --*) exit 9 ;;
    *) break ;;
  esac
  shift
done
if [ "$last" = none ]; then bash "$@" >&2; else
  for ((i = last; i >= 1; --i)); do
    SLURM_ARRAY_TASK_ID=$i SLURM_ARRAY_TASK_MIN=1 SLURM_ARRAY_TASK_MAX=$last SLURM_CPUS_PER_TASK=1 bash "$@" >&2
  done
fi
echo 17
)";
  fs::permissions(folder_ / "sbatch", fs::perms::owner_all);
  const std::string command = "bench cornell --size 8x8 --methods path,path-pure --samples 4 --repeats 2";
  ASSERT_EQ(run(command + " --threads 1 --out one").code, 0);
  const std::string submit = "cd " + folder_.string() + " && export ETENDUE=" + ETENDUE_BINARY +
                             " PATH=" + folder_.string() + ":$PATH SBATCH_OPTIONS=--cpus-per-task=1 && " +
                             (fs::path(ETENDUE_SOURCE_DIR) / "tools/cluster/submit_parts.sh").string() + " 3 array " +
                             command + " >log.txt 2>&1";
  ASSERT_EQ(std::system(submit.c_str()), 0) << slurp(folder_ / "log.txt");
  EXPECT_EQ(errors_of(slurp(folder_ / "one/curves.csv")), errors_of(slurp(folder_ / "array/curves.csv")));
  // A lost part is computed again, the others are kept.
  fs::remove(folder_ / "array.parts" / name_of(2, 3));
  fs::remove_all(folder_ / "array");
  ASSERT_EQ(std::system(submit.c_str()), 0) << slurp(folder_ / "log.txt");
  EXPECT_NE(slurp(folder_ / "log.txt").find("part-1-of-3.part exists"), std::string::npos);
  EXPECT_EQ(errors_of(slurp(folder_ / "one/curves.csv")), errors_of(slurp(folder_ / "array/curves.csv")));
}

}  // namespace
}  // namespace etendue::test::job_parts_test
