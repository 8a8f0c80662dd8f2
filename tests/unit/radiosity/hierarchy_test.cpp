// Hierarchical form factors against exact ones, and their number.
#include "radiosity/hierarchy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "radiosity/closed_forms.h"
#include "radiosity/reflectance.h"
#include "radiosity/scene_solution.h"
#include "scene/builtin/builtin.h"
#include "scene/builtin/shapes.h"

namespace etendue::radiosity {
namespace {

std::shared_ptr<const scene::CompiledScene> compiled_scene(scene::Scene scene) {
  return scene::compile(std::make_shared<const scene::Scene>(std::move(scene)), Camera(), nullptr);
}

std::shared_ptr<const scene::CompiledScene> hierarchy_cube() {
  scene::Scene s;
  scene::add(s, scene::cube(0.5f, true), scene::diffuse(Rgb(0.5f)));
  return compiled_scene(std::move(s));
}

Hierarchy linked(const scene::CompiledScene& scene, const PatchMesh& mesh, const HierarchySettings& settings) {
  Hierarchy hierarchy(mesh, settings);
  for (int task = 0; task < hierarchy.tasks(); ++task) EXPECT_TRUE(hierarchy.run(scene, task, nullptr));
  hierarchy.finish();
  return hierarchy;
}

// The leaves are all elements, each once, and light of the elements of one side of a cube arrives at the others by the
// closed forms.
TEST(Hierarchy, FactorsOfTheCube) {
  const auto scene = hierarchy_cube();
  const PatchMesh mesh(*scene, {Meshing::quadtree, 800, 0});
  ASSERT_EQ(mesh.patches().size(), 12u * 64);
  const Hierarchy hierarchy = linked(*scene, mesh, {.error = 0.01});
  const auto side = [&](const Vec3& normal) {
    std::vector<uint32_t> list;
    for (uint32_t e = 0; e < mesh.element_count(); e += 2)
      if (glm::dot(mesh.normal_of(e), normal) > 0.99f) list.push_back(e);
    return list;
  };
  std::vector<Rgb> floor_light(mesh.element_count());
  for (const uint32_t e : side({0, 1, 0})) floor_light[e] = Rgb(1);
  const std::vector<Rgb> irradiance = hierarchy.gather(floor_light);
  const auto mean = [&](const Vec3& normal) {
    double sum = 0;
    const auto list = side(normal);
    for (const uint32_t e : list) sum += static_cast<double>(irradiance[e].g) / static_cast<double>(list.size());
    return sum;
  };
  EXPECT_NEAR(mean({0, -1, 0}), parallel_rectangles(1, 1, 1), 1e-3);
  EXPECT_NEAR(mean({1, 0, 0}), perpendicular_rectangles(1, 1), 2e-3);
  EXPECT_EQ(mean({0, 1, 0}), 0);
  const std::vector<double>& closures = hierarchy.closures();
  double deviation = 0;
  for (uint32_t e = 0; e < mesh.element_count(); ++e) {
    if (!PatchMesh::is_front(e)) {
      EXPECT_EQ(closures[e], 0) << e;
      continue;
    }
    EXPECT_NEAR(closures[e], 1, 0.2) << e;
    deviation += std::abs(closures[e] - 1) / static_cast<double>(mesh.patches().size());
  }
  EXPECT_LT(deviation, 0.06);
}

// A closed cube that emits and reflects alike everywhere: H = S / (1 - rho), whatever the links.
TEST(Hierarchy, Furnace) {
  const auto scene = hierarchy_cube();
  const PatchMesh mesh(*scene, {Meshing::quadtree, 192, 0});
  const Hierarchy hierarchy = linked(*scene, mesh, {.error = 0.05});
  const std::vector<Rgb> grey(mesh.patches().size(), Rgb(0.8f)), direct(mesh.element_count(), Rgb(1));
  const IrradianceField field = solve_hierarchically(hierarchy, grey, direct, {.tolerance = 1e-6});
  for (uint32_t e = 0; e < mesh.element_count(); e += 2) EXPECT_NEAR(field.total[e].r, 5, 1e-3f) << e;
}

// The number of links per element does not grow with the mesh.
TEST(Hierarchy, LinksGrowWithTheNumberOfElements) {
  const auto scene = hierarchy_cube();
  double before = 0;
  for (const int patches : {768, 3072, 12'288}) {
    const PatchMesh mesh(*scene, {Meshing::quadtree, patches, 0});
    ASSERT_EQ(mesh.patches().size(), static_cast<size_t>(patches));
    const Hierarchy hierarchy = linked(*scene, mesh, {.error = 0.02, .rays = 1});
    const double per_element = static_cast<double>(hierarchy.links()) / patches;
    EXPECT_LT(hierarchy.links(), static_cast<size_t>(patches) * static_cast<size_t>(patches) / 16);
    if (before > 0) {
      EXPECT_LT(per_element, 1.05 * before) << patches;
    }
    before = per_element;
  }
}

TEST(Hierarchy, CanBeStopped) {
  const auto scene = hierarchy_cube();
  const PatchMesh mesh(*scene, {Meshing::quadtree, 3072, 0});
  Hierarchy hierarchy(mesh, {.error = 0.005});
  const KeepGoing never = [] { return false; };
  EXPECT_FALSE(hierarchy.run(*scene, 0, &never));
}

// The Cornell box: hierarchical form factors give the irradiance of flat ones within a few per cent, with fewer numbers.
TEST(Hierarchy, AgreesWithFlatFormFactors) {
  const auto scene = compiled_scene(scene::find_builtin("cornell")->make());
  const PatchMesh mesh(*scene, {Meshing::quadtree, 1200, 0});
  const std::vector<Rgb> reflectance = patch_reflectances(*scene, mesh);
  SolutionPlan plan;
  plan.factors = {FormFactorMethod::hemisphere, 1024};
  plan.light_samples = 128;
  SceneSolution flat(plan, mesh.element_count());
  for (int task = 0; task < flat.tasks(); ++task) flat.run(*scene, mesh, task, nullptr);
  flat.finish(mesh, reflectance);
  const Hierarchy hierarchy = linked(*scene, mesh, {.error = 0.01});
  const IrradianceField field = solve_hierarchically(hierarchy, reflectance, flat.direct(), {.tolerance = 1e-4});
  EXPECT_EQ(field.problem, "");
  double difference = 0, sum = 0;
  for (uint32_t e = 0; e < mesh.element_count(); ++e) {
    const double a = mesh.patch_of(e).area;
    difference += a * std::abs(static_cast<double>(luminance(field.indirect[e] - flat.field().indirect[e])));
    sum += a * static_cast<double>(luminance(flat.field().indirect[e]));
  }
  EXPECT_LT(difference, 0.07 * sum);
  EXPECT_LT(hierarchy.memory(), flat.factors()->memory());
}

TEST(Hierarchy, ReflectanceOneIsReported) {
  const auto scene = hierarchy_cube();
  const PatchMesh mesh(*scene, {Meshing::quadtree, 48, 0});
  const Hierarchy hierarchy = linked(*scene, mesh, {});
  const std::vector<Rgb> white(mesh.patches().size(), Rgb(1.2f)), direct(mesh.element_count(), Rgb(1));
  const IrradianceField field = solve_hierarchically(hierarchy, white, direct, {});
  EXPECT_TRUE(field.has_diverged);
  EXPECT_EQ(field.total, direct);
}

}  // namespace
}  // namespace etendue::radiosity
