// Other renderers as methods of a benchmark: their commands, the number of samples of each run, and their times.
#include "bench/external_renderer.h"

#include <gtest/gtest.h>

#include "bench/method_spec.h"
#include "bench/shell_command.h"
#include "support/scenes.h"

namespace etendue::test {
namespace {

using bench::ExternalRun;

bool keep_going() { return true; }

TEST(ExternalRenderer, TimeIsSplitIntoStartupAndRendering) {
  const ExternalRun runs[] = {{1, 5.5}, {2, 6}, {16, 13}};
  EXPECT_DOUBLE_EQ(bench::time_of(runs).startup, 5);
  EXPECT_DOUBLE_EQ(bench::time_of(runs).per_sample, 0.5);
}

TEST(ExternalRenderer, HasNoStartupIfTimesDoNotTell) {
  const ExternalRun one[] = {{4, 2}}, falling[] = {{1, 2}, {4, 1}}, steep[] = {{1, 1}, {4, 8}};
  EXPECT_EQ(bench::time_of(one).startup, 0);
  EXPECT_EQ(bench::time_of(one).per_sample, 0.5);
  EXPECT_EQ(bench::time_of(falling).startup, 0);
  EXPECT_EQ(bench::time_of(falling).per_sample, 0.25);
  EXPECT_EQ(bench::time_of(steep).startup, 0);
  EXPECT_EQ(bench::time_of(steep).per_sample, 2);
}

TEST(ExternalRenderer, RunsDoubleUpToTheLimit) {
  std::vector<ExternalRun> runs;
  std::vector<uint32_t> samples;
  while (const uint32_t next = bench::next_external_samples(runs, 0, 20)) {
    samples.push_back(next);
    runs.push_back({next, 1 + 0.5 * next});
  }
  EXPECT_EQ(samples, (std::vector<uint32_t>{1, 2, 4, 8, 16, 20}));
}

TEST(ExternalRenderer, TheLastRunUsesTheBudgetWithoutStartup) {
  std::vector<ExternalRun> runs;
  while (const uint32_t next = bench::next_external_samples(runs, 10, 0)) runs.push_back({next, 3 + 0.5 * next});
  EXPECT_EQ(runs.back().samples, 20u);
  EXPECT_DOUBLE_EQ(bench::time_of(runs).startup, 3);
}

TEST(ExternalRenderer, RunsDoubleUntilRenderingTakesTime) {
  std::vector<ExternalRun> runs;
  while (const uint32_t next = bench::next_external_samples(runs, 4, 0)) runs.push_back({next, 9 + 0.01 * next});
  EXPECT_EQ(runs.back().samples, 400u);
  EXPECT_NEAR(bench::time_of(runs).startup, 9, 1e-9);
}

TEST(ExternalRenderer, IsAMethodOfAListOnly) {
  const std::string spec = "external:\"tools/render.sh a,b {spp} {seed} {out}\"";
  const auto methods = bench::parse_methods("path," + spec + ",bdpt", cornell(8));
  ASSERT_TRUE(methods) << methods.error().message;
  ASSERT_EQ(methods->size(), 3u);
  EXPECT_FALSE(methods->at(0).is_external());
  EXPECT_EQ(methods->at(1).command, "tools/render.sh a,b {spp} {seed} {out}");
  EXPECT_EQ(methods->at(1).label(), "render");
  EXPECT_EQ(methods->at(1).name, spec);
  EXPECT_FALSE(bench::parse_method(spec, cornell(8)));
}

TEST(ExternalRenderer, NeedsItsPlaceholders) {
  for (const char* command : {"a {spp} {seed}", "a {spp} {out}", "a {seed} {out}"})
    EXPECT_FALSE(bench::parse_methods("external:" + std::string(command), cornell(8))) << command;
}

TEST(ShellCommand, TakesTheTimeOfTheProgram) {
  const auto seconds = bench::run_shell_command("sleep 0.1", keep_going);
  ASSERT_TRUE(seconds);
  EXPECT_GE(*seconds, 0.1);
}

TEST(ShellCommand, ReportsTheLastLineOfAnError) {
  const auto result = bench::run_shell_command("echo one >&2; echo two >&2; exit 3", keep_going);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().message, "the program ended with exit code 3: two");
}

TEST(ShellCommand, IsInterruptedWithItsChildren) {
  const auto result = bench::run_shell_command("sleep 60 & wait", [] { return false; });
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().fault, Fault::interrupted);
}

}  // namespace
}  // namespace etendue::test
