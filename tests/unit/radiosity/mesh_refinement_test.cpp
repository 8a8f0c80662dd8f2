// Adaptive meshes: places in the quadtrees, and where patches are divided.
#include "radiosity/mesh_refinement.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scene/builtin/shapes.h"

namespace etendue::radiosity {
namespace {

using scene::add;
using scene::diffuse;

std::shared_ptr<const scene::CompiledScene> compiled_mesh(scene::Scene scene) {
  return scene::compile(std::make_shared<const scene::Scene>(std::move(scene)), Camera(), nullptr);
}

// A floor of 4 x 4 m, a square of 1 x 1 m above its centre, and a point light 4 m above the floor. The shadow is a square
// of 2 x 2 m.
std::shared_ptr<const scene::CompiledScene> floor_with_shadow() {
  scene::Scene s;
  add(s, scene::rectangle({-2, 0, -2}, {0, 0, 4}, {4, 0, 0}), diffuse(Rgb(0.5f)));
  add(s, scene::rectangle({-0.5f, 2, -0.5f}, {0, 0, 1}, {1, 0, 0}), diffuse(Rgb(0.5f)));
  s.lights.push_back(make_light("point"));
  scene::Node node;
  node.light = 0;
  glm::mat4 raised(1.0f);
  raised[3] = glm::vec4(0, 4, 0, 1);
  node.transform.matrix = raised;
  s.nodes.push_back(node);
  s.roots.push_back(static_cast<int>(s.nodes.size()) - 1);
  return compiled_mesh(std::move(s));
}

void expect_consistent(const PatchMesh& mesh, double area) {
  EXPECT_NEAR(mesh.quality().area, area, 1e-4 * area);
  for (uint32_t p = 0; p < mesh.patches().size(); ++p) {
    const Patch& patch = mesh.patches()[p];
    const float doubled = glm::length(glm::cross(patch.p1 - patch.p0, patch.p2 - patch.p0));
    EXPECT_NEAR(doubled / 2, patch.area, 1e-4f * patch.area);
    for (const Vec2 b : {Vec2(0.3f, 0.3f), Vec2(0.1f, 0.8f), Vec2(0.05f, 0.05f), Vec2(0.6f, 0.2f)}) {
      const Vec2 in_triangle = mesh.in_triangle(p, b);
      const auto at = mesh.locate(patch.instance, patch.triangle, in_triangle.x, in_triangle.y, true);
      ASSERT_EQ(at.element, 2 * p);
      EXPECT_NEAR(at.barycentric.x, b.x, 1e-3f);
      EXPECT_NEAR(at.barycentric.y, b.y, 1e-3f);
      EXPECT_LT(glm::distance(patch.point(at.barycentric), patch.point(b)), 1e-4f);
    }
  }
}

TEST(RefinedMesh, EveryPointHasItsPatch) {
  const auto scene = floor_with_shadow();
  PatchMesh mesh(*scene, {Meshing::uniform, 0, 3});
  size_t count = mesh.patches().size();
  for (int round = 0; round < 4; ++round) {
    std::vector<char> divided(count, 0);
    for (size_t p = static_cast<size_t>(round); p < count; p += 3) divided[p] = 1;
    std::vector<uint32_t> parts_of;
    const PatchMesh refined = mesh.refined(divided, &parts_of);
    const auto number = static_cast<size_t>(std::ranges::count(divided, 1));
    ASSERT_EQ(refined.patches().size(), count + 3 * number);
    ASSERT_EQ(parts_of.size(), refined.patches().size());
    for (size_t p = 0; p < parts_of.size(); ++p)
      EXPECT_FLOAT_EQ(refined.patches()[p].area,
                      mesh.patches()[parts_of[p]].area / (divided[parts_of[p]] ? 4.0f : 1.0f));
    expect_consistent(refined, 17);
    mesh = refined;
    count = mesh.patches().size();
  }
}

// Nearly all divided patches are at the edge of the shadow, and there are not more patches than allowed.
TEST(RefinedMesh, PatchesAreDividedAtTheEdgeOfAShadow) {
  const auto scene = floor_with_shadow();
  const MeshSettings settings{Meshing::adaptive, 1500, 0};
  const PatchMesh mesh = complete_mesh(*scene, settings, 1);
  EXPECT_LE(mesh.patches().size(), 1500u);
  EXPECT_GT(mesh.patches().size(), 1350u);
  EXPECT_EQ(count_patches(*scene, settings), 1500u);
  expect_consistent(mesh, 17);
  size_t small = 0, at_edge = 0;
  for (const Patch& patch : mesh.patches()) {
    if (patch.area > 1.5 * mesh.quality().smallest || patch.p0.y > 1) continue;
    ++small;
    const auto depth = [](const Vec3& p) { return std::max(std::abs(p.x), std::abs(p.z)); };
    const auto [least, most] = std::minmax({depth(patch.p0), depth(patch.p1), depth(patch.p2)});
    at_edge += least <= 1.05f && most >= 0.95f ? 1 : 0;
  }
  EXPECT_GT(small, 100u);
  EXPECT_EQ(at_edge, small);
}

// The same mesh with any order of the tasks, and in parts.
TEST(RefinedMesh, DoesNotDependOnTheOrderOfTasks) {
  const auto scene = floor_with_shadow();
  const MeshSettings settings{Meshing::adaptive, 600, 0};
  MeshRefinement refinement(*scene, settings, 1);
  const KeepGoing stop = [] { return false; };
  EXPECT_FALSE(refinement.run(*scene, 0, &stop));
  while (!refinement.is_ready()) {
    for (int task = refinement.tasks() - 1; task >= 0; --task) refinement.run(*scene, task, nullptr);
    refinement.finish_round(*scene);
  }
  EXPECT_EQ(refinement.tasks(), 0);
  EXPECT_TRUE(refinement.mesh() == complete_mesh(*scene, settings, 1));
}

// Black surfaces and scenes without light are not divided; a mesh with more triangles than patches stays as it is.
TEST(RefinedMesh, NothingIsDividedWithoutReason) {
  scene::Scene dark;
  add(dark, scene::rectangle({-2, 0, -2}, {0, 0, 4}, {4, 0, 0}), diffuse(Rgb(0.5f)));
  const auto unlit = compiled_mesh(std::move(dark));
  EXPECT_EQ(complete_mesh(*unlit, {Meshing::adaptive, 300, 0}, 1).patches().size(), 162u);
  EXPECT_EQ(complete_mesh(*floor_with_shadow(), {Meshing::adaptive, 1, 0}, 1).patches().size(), 4u);
}

}  // namespace
}  // namespace etendue::radiosity
