// The paths that integrators declare against the paths that they sample, for every integrator of the registry. False
// declarations are detected.
#include "advisor/missing_paths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "advisor/reference_integrator.h"
#include "render/incompatibility.h"
#include "scene/compiled_scene.h"
#include "statistical/advisor/test_scenes.h"
#include "transport/path_expression/path_expression.h"

namespace etendue::test {
namespace {

using advisor::ClassTable;
using advisor::DeclaredPaths;
using advisor::MissingPaths;
using transport::Automaton;
using transport::PathExpression;

constexpr size_t kPlaces = 4;  // scenes in which all integrators are compared

// The threshold for all comparisons with a common false-alarm rate of 1 %: two-sided, Sidak.
double threshold(size_t comparisons) {
  const double alarms = 1 - std::pow(0.99, 1.0 / static_cast<double>(comparisons));
  double low = 0, high = 10;
  while (high - low > 1e-6) {
    const double middle = 0.5 * (low + high);
    (std::erfc(middle / std::sqrt(2.0)) > alarms ? low : high) = middle;
  }
  return low;
}

advisor::ClassEnergy energy_by(const std::string& integrator, const render::Document& d, const std::string& paths,
                               uint32_t samples) {
  render::Document made =
      changed(changed(advisor::with_reference_integrator(d), "film.paths", paths), "render.integrator", integrator);
  made.seed = 77;
  return advisor::class_energy(rendered(made, samples));
}

// The table of path classes. All integrators are compared with its energies, so one that is off by chance would count
// once for each of them; noisy ones are therefore measured again with many samples.
ClassTable table_of(const render::Document& d) {
  constexpr double kNoisy = 0.005;  // standard error relative to the mean
  constexpr uint32_t kSamples = 1024;
  render::Session session({2});
  ClassTable table = advisor::class_table(session, d, {}, never_cancel);
  for (auto& row : table.rows) {
    if (row.energy.uncertain() || row.energy.standard_error < kNoisy * row.energy.mean) continue;
    const auto reference = changed(advisor::with_reference_integrator(d), "film.paths", row.paths);
    row.energy = advisor::class_energy(rendered(reference, kSamples));
  }
  return table;
}

// Contradictions between the declaration of an integrator and its images. `points`: the scene has point lights only.
std::vector<std::string> contradictions(const integrator::IntegratorInfo& info, const render::Document& d, bool points,
                                        const ClassTable& table) {
  const render::Document made = changed(advisor::with_reference_integrator(d), "render.integrator", info.name);
  const bool hindered = !render::incompatibility(made, *scene::compile(d.scene, d.camera, nullptr)).empty();
  const advisor::DeclaredPaths found = hindered ? advisor::DeclaredPaths() : advisor::declared_paths(info);
  const Automaton& declared = points ? found.point_paths : found.paths;
  std::vector<std::string> list;
  const Automaton rest = advisor::without(PathExpression::without_volumes().automaton(), declared);
  if (!rest.empty())
    if (const auto energy = energy_by(info.name, d, expression_of(rest), 16); energy.found())
      list.push_back("finds some of " + expression_of(rest));
  std::vector<const advisor::ClassRow*> rows;
  for (const auto& row : table.rows)
    if (!row.energy.uncertain() && advisor::without(advisor::common(PathExpression::parse_paths(row.paths)->automaton(),
                                                                    PathExpression::without_volumes().automaton()),
                                                    declared)
                                       .empty())
      rows.push_back(&row);
  // Biased integrators must only find some light; unbiased integrators must find its amount.
  const bool unbiased = info.bias == integrator::Bias::unbiased;
  for (const auto* row : rows) {
    const auto energy = energy_by(info.name, unbiased ? d : sized(d, 16), row->paths, unbiased ? 128 : 64);
    if (!energy.found()) list.push_back("finds nothing of " + row->paths);
    if (!unbiased) continue;
    const double z = (energy.mean - row->energy.mean) / std::hypot(energy.standard_error, row->energy.standard_error);
    if (std::abs(z) > threshold(rows.size() * integrator::integrator_infos().size() * kPlaces))
      list.push_back(row->paths + " is off by " + std::to_string(z) + " sigma");
  }
  return list;
}

struct Place {
  const char* name;
  render::Document document;
  bool points;
};

std::array<Place, kPlaces> places() {
  return {{{"area", glossy_scene_under(true, false, false, 32), false},
           {"sky", glossy_scene_under(false, true, false, 32), false},
           {"point", glossy_scene_under(false, false, true, 32), true},
           {"cornell", cornell(32), false}}};
}

TEST(Declared, EqualsThePathsThatAreSampled) {
  for (const auto& place : places()) {
    const ClassTable table = table_of(place.document);
    for (const auto& info : integrator::integrator_infos())
      for (const auto& contradiction : contradictions(info, place.document, place.points, table))
        ADD_FAILURE() << info.name << " under " << place.name << ": " << contradiction;
  }
}

TEST(Declared, AFalseDeclarationIsDetected) {
  const auto d = glossy_scene_under(true, false, false, 32), points = glossy_scene_under(false, false, true, 32);
  const auto table = table_of(d), under_points = table_of(points);
  const auto said = [](const char* name, const char* paths, const char* point_paths) {
    auto info = *integrator::find_integrator(name);
    info.paths = paths;
    info.point_paths = point_paths;
    return info;
  };
  EXPECT_FALSE(contradictions(said("raycast", "E.*L", ""), d, false, table).empty());
  EXPECT_FALSE(contradictions(said("raycast", "EL", ""), d, false, table).empty());
  EXPECT_FALSE(contradictions(said("path", "E[D|G]L", ""), d, false, table).empty());
  EXPECT_FALSE(contradictions(said("raycast", "E.*L", "E.*DL"), points, true, under_points).empty());
  EXPECT_FALSE(contradictions(said("path", "E.*L", ""), points, true, under_points).empty());
}

TEST(Declared, AnIncompatibleIntegratorSamplesNothing) {
  const auto d = changed(glossy_scene_under(true, false, false, 16), "render.integrator", "light-pure");
  const auto found = [](const render::Document& document) {
    return advisor::declared_paths(document, *scene::compile(document.scene, document.camera, nullptr));
  };
  EXPECT_TRUE(found(d).paths.empty());
  EXPECT_FALSE(found(changed(d, "camera.lens-radius", "0.1")).paths.empty());
  const auto points = changed(glossy_scene_under(false, false, true, 16), "render.integrator", "path-pure");
  EXPECT_TRUE(found(points).paths.empty());
  EXPECT_FALSE(
      found(changed(glossy_scene_under(true, false, true, 16), "render.integrator", "path-pure")).paths.empty());
}

TEST(Declared, PointPathsAreASubsetOfThePaths) {
  for (const auto& info : integrator::integrator_infos()) {
    const advisor::DeclaredPaths found = advisor::declared_paths(info);
    EXPECT_TRUE(advisor::without(found.point_paths, found.paths).empty()) << info.name;
  }
}

TEST(Declared, ACausticsMapAddsPaths) {
  const auto declared = [](const char* photons) {
    const auto igi = changed(cornell(8), "render.integrator", "igi");
    return advisor::declared_paths(changed(igi, "igi.caustic-photons", photons).method);
  };
  const Automaton caustics = PathExpression::parse_paths("ES*(D|G)S+L")->automaton();
  EXPECT_TRUE(advisor::common(declared("0").paths, caustics).empty());
  const advisor::DeclaredPaths found = declared("1000");
  EXPECT_TRUE(advisor::without(caustics, found.paths).empty());
  EXPECT_TRUE(advisor::without(caustics, found.point_paths).empty());
  EXPECT_TRUE(advisor::without(found.point_paths, found.paths).empty());
}

TEST(Declared, ADepthLimitRemovesPaths) {
  const auto found = advisor::declared_paths(changed(cornell(8), "path.max-depth", "2").method);
  EXPECT_EQ(found.paths, PathExpression::parse_paths("E[.]L")->automaton());
  EXPECT_EQ(found.point_paths, PathExpression::parse_paths("E(D|G|V)L")->automaton());
  EXPECT_EQ(advisor::bias_of(changed(cornell(8), "path.max-depth", "2").method), integrator::Bias::biased);
  EXPECT_EQ(advisor::bias_of(cornell(8).method), integrator::Bias::unbiased);
}

TEST(MissingPaths, NoneForACompleteIntegrator) {
  const ClassTable table = table_of(glossy_scene_under(true, true, true, 16));
  const MissingPaths none =
      advisor::missing_paths(advisor::declared_paths(*integrator::find_integrator("bdpt")), table);
  EXPECT_TRUE(none.none());
  EXPECT_EQ(none.share, 0);
  EXPECT_EQ(advisor::missing_paths_text(none), "misses no path class with measurable energy");
  // Path tracing does not find caustics of point lights.
  const MissingPaths caustics =
      advisor::missing_paths(advisor::declared_paths(*integrator::find_integrator("path")), table);
  EXPECT_FALSE(caustics.none());
  for (const auto& missing : caustics.classes) EXPECT_TRUE(missing.from_point_lights) << missing.paths;
}

// The missing energy and error equal those of a rendering without these paths.
TEST(MissingPaths, ShareAndErrorOfTheMissingPaths) {
  const auto d = glossy_scene_under(true, true, false, 32);
  const ClassTable table = table_of(d);
  const MissingPaths missing =
      advisor::missing_paths(advisor::declared_paths(*integrator::find_integrator("raycast")), table);
  const auto whole = energy_by("path", d, "", 256), rest = energy_by("path", d, "E(S|(D|G).).*L", 256);
  EXPECT_NEAR(missing.share, rest.mean / whole.mean, 0.05);
  EXPECT_NEAR(missing.rms, advisor::rms_of({&rest, 1}), 0.1 * missing.rms);
  for (const auto& spot : missing.classes) EXPECT_FALSE(spot.partial) << spot.paths;
  EXPECT_TRUE(advisor::missing_paths_text(missing).starts_with("misses ")) << advisor::missing_paths_text(missing);
}

TEST(MissingPaths, PointLightsCannotBeHitByPaths) {
  const ClassTable alone = table_of(glossy_scene_under(false, false, true, 16)),
                   mixed = table_of(glossy_scene_under(true, false, true, 16));
  const advisor::DeclaredPaths pure = advisor::declared_paths(*integrator::find_integrator("path-pure"));
  EXPECT_NEAR(advisor::missing_paths(pure, alone).share, 1, 1e-6);
  const MissingPaths missing = advisor::missing_paths(pure, mixed);
  EXPECT_NEAR(missing.share, mixed.total.from_points.mean / mixed.total.energy.mean, 1e-3);
  EXPECT_TRUE(std::ranges::all_of(missing.classes, &advisor::MissingPathClass::from_point_lights));
}

TEST(MissingPaths, PathsOutOfReachOfAllIntegrators) {
  const auto sentences = [](const render::Document& d) {
    return advisor::beyond_all_methods(*scene::compile(d.scene, d.camera, nullptr));
  };
  // Light subpaths find the light of a point light through glass.
  EXPECT_TRUE(sentences(glossy_scene_under(false, false, true, 16)).empty());
  EXPECT_TRUE(sentences(glossy_scene_under(true, true, false, 16)).empty());
  auto plain = cornell(16);
  scene::Scene scene = *plain.scene;
  test::add_point_light(scene, {0, 0, 0}, 1);
  plain.scene = std::make_shared<const scene::Scene>(scene);
  EXPECT_TRUE(sentences(plain).empty());
}

}  // namespace
}  // namespace etendue::test
