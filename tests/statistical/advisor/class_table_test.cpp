// The table of path classes: its rows partition the paths, sum to the image, and are split where it is worthwhile.
#include "advisor/class_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "advisor/declared_paths.h"
#include "advisor/reference_integrator.h"
#include "statistical/advisor/test_scenes.h"
#include "transport/path_expression/path_expression.h"

namespace etendue::test {
namespace {

using advisor::ClassTable;
using advisor::TableOptions;
using transport::Automaton;
using transport::PathExpression;

ClassTable table_of(const render::Document& d, const TableOptions& options = {}) {
  render::Session session({2});
  return advisor::class_table(session, d, options, never_cancel);
}

std::vector<std::string> classes_of(const ClassTable& table) {
  std::vector<std::string> list = table.unseen;
  for (const auto& row : table.rows) list.push_back(row.paths);
  return list;
}

// Partitions of the paths of scenes without scattering media; '.' also matches V, which they do not have.
void expect_partition(const std::vector<std::string>& classes, const Automaton& whole) {
  const Automaton& space = PathExpression::without_volumes().automaton();
  Automaton rest = advisor::common(whole, space);
  for (const auto& paths : classes) {
    const auto expression = PathExpression::parse_paths(paths);
    ASSERT_TRUE(expression) << paths << ' ' << expression.error().message;
    const Automaton own = advisor::common(expression->automaton(), space);
    EXPECT_TRUE(advisor::without(own, rest).empty()) << paths << " overlaps";
    rest = advisor::without(rest, own);
  }
  EXPECT_TRUE(rest.empty()) << expression_of(rest);
}

TEST(ClassTable, RowsPartitionThePathsAndSumToTheImage) {
  for (const auto& d : {cornell(24), glossy_scene_under(true, true, false, 24)}) {
    const ClassTable table = table_of(d);
    EXPECT_TRUE(table.finished);
    EXPECT_GT(table.rows.size(), 2u);
    expect_partition(classes_of(table), PathExpression::without_volumes().automaton());
    double sum = 0;
    std::vector<float> pixels(24 * 24 * 3, 0.0f);
    for (const auto& row : table.rows) {
      sum += row.energy.mean;
      for (size_t i = 0; i < pixels.size(); ++i) pixels[i] += row.energy.image->first[i];
    }
    EXPECT_NEAR(sum, table.total.energy.mean, 1e-5 * sum);
    // The same random numbers give the same image.
    const auto film = rendered(advisor::with_reference_integrator(d), table.samples);
    const auto whole = advisor::class_energy(film);
    EXPECT_EQ(whole.mean, table.total.energy.mean);
    for (size_t i = 0; i < pixels.size(); ++i)
      ASSERT_NEAR(pixels[i], whole.image->first[i], 1e-4 * whole.image->first[i] + 1e-6);
  }
}

TEST(ClassTable, RowsPartitionThePathsAfterAnEarlyStop) {
  TableOptions brief;
  brief.max_rows = 3;
  brief.samples = 2;
  const ClassTable table = table_of(glossy_scene_under(true, true, false, 16), brief);
  expect_partition(classes_of(table), PathExpression::without_volumes().automaton());
  double sum = 0;
  for (const auto& row : table.rows) sum += row.energy.mean;
  EXPECT_NEAR(sum, table.total.energy.mean, 1e-5 * sum);
}

TEST(ClassTable, IsRestrictedToThePathExpression) {
  const auto d = changed(glossy_scene_under(true, true, false, 16), "film.paths", "E.*S.*L");
  const ClassTable table = table_of(d);
  expect_partition(classes_of(table), PathExpression::parse_paths("E.*S.*L")->automaton());
  EXPECT_EQ(table.paths, "E(D|G)*S.*L");
  EXPECT_GT(table.rows.size(), 2u);
}

TEST(ClassTable, RowsAreWhollySampledOrNotSampled) {
  const ClassTable table = table_of(glossy_scene_under(true, true, false, 24));
  for (const auto& info : integrator::integrator_infos())
    for (const auto& row : table.rows) {
      const Automaton paths = advisor::common(PathExpression::parse_paths(row.paths)->automaton(),
                                              PathExpression::without_volumes().automaton());
      const Automaton found = advisor::common(paths, advisor::declared_paths(info).paths);
      EXPECT_TRUE(found.empty() || found == paths) << info.name << ' ' << row.paths;
    }
}

// The spread of repeats with different seeds agrees with the stated standard error: chi-square with 30 degrees of
// freedom, 0.1 % false alarms on either side.
TEST(ClassTable, StandardErrorsAgreeWithRepeats) {
  constexpr int kRepeats = 30;
  const auto d = cornell(16);
  std::vector<double> means;
  double claimed = 0;
  for (int i = 0; i < kRepeats; ++i) {
    auto again = changed(advisor::with_reference_integrator(d), "film.paths", "EDD+L");
    again.seed = 100 + static_cast<uint64_t>(i);
    const auto energy = advisor::class_energy(rendered(again, 8));
    means.push_back(energy.mean);
    claimed += sqr(energy.standard_error) / kRepeats;
  }
  double mean = 0, squares = 0;
  for (const double m : means) mean += m / kRepeats;
  for (const double m : means) squares += sqr(m - mean);
  EXPECT_GT(squares / claimed, 10.2);
  EXPECT_LT(squares / claimed, 60);
}

// A caustic of a small light is hit by few paths, and the table marks its row as uncertain.
TEST(ClassTable, MarksUncertainRows) {
  scene::Scene scene;
  add(scene, quad(4), diffuse(Rgb(0.6f)));
  Mat4 place(1);
  place[3] = Vec4(0, 0.6f, 0, 1);
  add(scene, sphere(0.5f, 32, false), scene::glass(), place);
  Mat4 above(1);
  above[1][1] = -1;
  above[2][2] = -1;
  above[3] = Vec4(0, 3, 1, 1);
  add(scene, quad(0.3f), diffuse(Rgb(0), Rgb(90)), above);
  const auto table = table_of(document(scene, look_at({0, 2, 5}, {0, 0.4f, 0}, {0, 1, 0}, 0.8f), 64, 64));
  double direct = 0;
  bool doubted = false;
  for (const auto& row : table.rows) {
    if (row.paths == "EDL") {
      direct = row.energy.mean;
      EXPECT_FALSE(row.energy.uncertain());
    }
    if (PathExpression::parse_paths(row.paths)->matches("EDSSL")) doubted = row.energy.uncertain();
  }
  EXPECT_GT(direct, 0);
  EXPECT_TRUE(doubted);
}

TEST(ClassTable, SeparatesPointLights) {
  const auto mixed = table_of(glossy_scene_under(true, false, true, 24)),
             none = table_of(glossy_scene_under(true, true, false, 24)),
             alone = table_of(glossy_scene_under(false, false, true, 24));
  EXPECT_TRUE(mixed.point_lights);
  const auto whole = mixed.total;
  EXPECT_GT(whole.from_points.mean, 0.05 * whole.energy.mean);
  EXPECT_LT(whole.from_points.mean, 0.95 * whole.energy.mean);
  const auto& points = alone.total.energy;
  EXPECT_NEAR(whole.from_points.mean, points.mean, 5 * points.standard_error);
  EXPECT_FALSE(none.point_lights);
  EXPECT_FALSE(none.total.from_points.found());
  EXPECT_EQ(alone.total.from_points.mean, alone.total.energy.mean);
}

TEST(ClassTable, RefinesProgressivelyAndCanBeCancelled) {
  render::Session session({2});
  std::vector<size_t> rows;
  size_t asked = 0;
  const auto table = advisor::class_table(
      session, glossy_scene_under(true, true, false, 24), {},
      [&](double, const std::string&) { return ++asked < 2000; },
      [&](const ClassTable& t) { rows.push_back(t.rows.size()); });
  EXPECT_GT(rows.size(), 3u);
  EXPECT_TRUE(std::ranges::is_sorted(rows));
  const auto cut = advisor::class_table(session, cornell(64), {}, [](double, const std::string&) { return false; });
  EXPECT_FALSE(cut.finished);
}

TEST(ClassEnergy, RmsExcludesTheNoise) {
  auto d = advisor::with_reference_integrator(cornell(32));
  const auto noisy = advisor::class_energy(rendered(d, 32));
  const auto clean = rendered(d, 1024);
  double squares = 0;
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x)
      for (int c = 0; c < 3; ++c) squares += sqr(double{clean.mean(x, y)[c]}) / (3 * 32 * 32);
  EXPECT_NEAR(advisor::rms_of({&noisy, 1}), std::sqrt(squares), 0.02 * std::sqrt(squares));
}

}  // namespace
}  // namespace etendue::test
