// The command lines of README.md and of the first steps end without an error and without a warning. They run as they are
// printed there, with smaller images and shorter times.
#include <algorithm>
#include <regex>
#include <sstream>
#include <vector>

#include "integration/cli/cli.h"

namespace etendue::test::readme_test {
namespace {

// The lines of the shell that begin with "./run " and have arguments, below a heading of a Markdown file.
std::vector<std::string> command_lines(const std::string& file, const std::string& heading) {
  std::istringstream text(slurp(fs::path(ETENDUE_SOURCE_DIR) / file));
  std::vector<std::string> lines;
  bool is_inside = false, is_code = false;
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with("## ")) is_inside = line == "## " + heading;
    if (line.starts_with("```")) is_code = !is_code;
    if (!is_inside || !is_code || !line.starts_with("./run ")) continue;
    lines.push_back(line.substr(6, line.find(" #") - 6));
  }
  return lines;
}

// The same command with less work.
std::string reduced(std::string line) {
  const std::pair<const char*, const char*> replacements[] = {
      {R"(--size \d+x\d+)", "--size 12x9"}, {R"(--spp \d+)", "--spp 16 --size 48x48"},
      {R"(--budget \d+)", "--budget 0.05"}, {R"(--repeats \d+)", "--repeats 2"},
      {R"(--time \d+)", "--time 4"},        {R"(--integrator auto)", "--integrator auto --size 24x18"},
      {R"(--error [\d.]+)", "--error 0.1"}, {R"(^stress)", "stress point-light-unseen --size 16"}};
  for (const auto& [pattern, text] : replacements) line = std::regex_replace(line, std::regex(pattern), text);
  return line;
}

// Lines on standard error that are neither progress nor the announcement of a choice.
std::vector<std::string> warnings_in(const std::string& err) {
  std::istringstream text(err);
  std::vector<std::string> found;
  for (std::string line; std::getline(text, line);) {
    const bool is_choice = line.find("has the smallest predicted") != std::string::npos ||
                           line.find(": in longer pilots, ") != std::string::npos;
    if (line.starts_with("etendue: ") && !is_choice) found.push_back(line);
  }
  return found;
}

bool is_about_reference(const std::string& warning) { return warning.find("reference") != std::string::npos; }
bool is_about_reliability(const std::string& warning) { return warning.find("unreliable") != std::string::npos; }

class Readme : public Cli {
 protected:
  void expect_no_warning(const std::string& line) const {
    const Outcome r = line.starts_with("bench ")              ? run_benchmark(line)
                      : line.find(kTime) != std::string::npos ? run_for_a_time(line)
                                                              : run(line);
    EXPECT_EQ(r.code, 0) << line << "\n" << r.err;
    for (const auto& warning : warnings_in(r.err)) ADD_FAILURE() << line << "\n" << warning;
  }

 private:
  static constexpr const char* kTime = "--time 4";

  // On a busy machine or with a slow build, the samples of the time may be too few for a reliable error. The time is
  // increased until they suffice, at most to 64 seconds.
  Outcome run_for_a_time(const std::string& line) const {
    constexpr int kFirstSeconds = 4, kLastSeconds = 64;
    for (int seconds = kFirstSeconds;; seconds *= 2) {
      const Outcome r = run(std::regex_replace(line, std::regex(kTime), "--time " + std::to_string(seconds)));
      if (std::ranges::none_of(warnings_in(r.err), is_about_reliability) || seconds >= kLastSeconds) return r;
    }
  }

  // The reference of a benchmark has to be more exact than its images. A pass of a slow build takes longer than the whole
  // budget, so that the time of the reference is increased until it suffices, at most to 160 seconds.
  Outcome run_benchmark(const std::string& line) const {
    constexpr int kFirstSeconds = 20, kLastSeconds = 160;
    for (int seconds = kFirstSeconds;; seconds *= 2) {
      const Outcome r = run(line + " --reference-time " + std::to_string(seconds));
      const bool is_too_short = std::ranges::any_of(warnings_in(r.err), is_about_reference);
      if (!is_too_short || seconds >= kLastSeconds) return r;
    }
  }
};

TEST_F(Readme, FiveThingsToTry) {
  const auto lines = command_lines("README.md", "Five things to try");
  ASSERT_GE(lines.size(), 6u);
  for (const std::string& line : lines) expect_no_warning(reduced(line));
  for (const char* file : {"box.exr", "box.png", "other.exr", "caustic.exr", "bench/report.html", "stress/matrix.html"})
    EXPECT_TRUE(fs::exists(folder_ / file)) << file;
  expect_no_warning("certify box.exr --time 2");
}

TEST_F(Readme, FirstSteps) {
  const auto lines = command_lines("docs/guide/first-steps.md", "Five minutes on the command line");
  ASSERT_GE(lines.size(), 8u);
  // Images that are compared have the same size.
  for (const std::string& line : lines) {
    const bool is_compared = line.find("--integrator path-pure") != std::string::npos;
    expect_no_warning(reduced(line) + (is_compared ? " --size 48x48" : ""));
  }
}

// The filter finds a warning.
TEST_F(Readme, AWarningIsFound) {
  const Outcome r =
      run("bench cornell --size 16x16 --methods path --budget 0.3 --repeats 2 --reference-time 0.3 --out b");
  EXPECT_EQ(r.code, 0);
  EXPECT_EQ(warnings_in(r.err).size(), 1u) << r.err;
}

}  // namespace
}  // namespace etendue::test::readme_test
