// The Cornell box matches the published data. Every built-in scene is complete and deterministic, has closed glass
// meshes, is lit, and receives light along the paths that it demonstrates.
#include "scene/builtin/builtin.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "scene/builtin/cornell.h"
#include "scene/compiled_scene.h"
#include "support/scenes.h"

namespace etendue {
namespace {

// The mesh and the material of the node with this name.
struct Part {
  const Mesh* mesh;
  const Material* material;
};

Part part(const scene::Scene& scene, const std::string& name) {
  for (const auto& node : scene.nodes)
    if (node.name == name && node.mesh >= 0) {
      const auto& primitive = scene.meshes[static_cast<size_t>(node.mesh)].primitives[0];
      return {primitive.mesh.get(), &scene.materials[static_cast<size_t>(primitive.material)]};
    }
  return {};
}

Vec3 normal(const Mesh& mesh, const Triangle& t) {
  return glm::normalize(
      glm::cross(mesh.positions[t[1]] - mesh.positions[t[0]], mesh.positions[t[2]] - mesh.positions[t[0]]));
}

TEST(Cornell, HasItsParts) {
  const auto scene = scene::cornell_box();
  for (const char* name :
       {"floor", "ceiling", "back wall", "left wall", "right wall", "short box", "tall box", "light"}) {
    const Part p = part(scene, name);
    ASSERT_TRUE(p.mesh) << name;
    EXPECT_GT(p.mesh->positions.capacity(), p.mesh->positions.size());
    EXPECT_EQ(p.material->specular, 0) << name;
    EXPECT_EQ(p.material->metallic, 0);
    EXPECT_EQ(p.material->roughness, 1);
  }
  EXPECT_EQ(scene.roots.size(), scene.nodes.size());
}

TEST(Cornell, SurfacesFaceInwardsAndBlocksOutwards) {
  const auto scene = scene::cornell_box();
  const Vec3 middle(2.78f, 2.74f, 2.796f);
  for (const char* name : {"floor", "ceiling", "back wall", "left wall", "right wall", "light"}) {
    const Part p = part(scene, name);
    for (const auto& t : p.mesh->triangles)
      EXPECT_GT(glm::dot(normal(*p.mesh, t), middle - p.mesh->positions[t[0]]), 0) << name;
  }
  for (const char* name : {"short box", "tall box"}) {
    const Part p = part(scene, name);
    EXPECT_EQ(p.mesh->triangles.size(), 10U) << "blocks have no bottom face";
    const Vec3 center = bounds_of(*p.mesh, Mat4(1)).center();
    for (const auto& t : p.mesh->triangles)
      EXPECT_GT(glm::dot(normal(*p.mesh, t), p.mesh->positions[t[0]] - center), 0) << name;
  }
}

TEST(Cornell, ColoursAndLight) {
  const auto scene = scene::cornell_box();
  EXPECT_EQ(part(scene, "left wall").material->base_color, Rgb(0.63f, 0.065f, 0.05f));
  EXPECT_EQ(part(scene, "right wall").material->base_color, Rgb(0.14f, 0.45f, 0.091f));
  EXPECT_EQ(part(scene, "floor").material->base_color, Rgb(0.725f, 0.71f, 0.68f));
  const Part light = part(scene, "light");
  EXPECT_EQ(light.material->emission, Rgb(17, 12, 4));
  EXPECT_EQ(light.material->base_color, Rgb(0.78f));
  EXPECT_FALSE(light.material->double_sided);
  for (const auto& t : light.mesh->triangles) EXPECT_EQ(normal(*light.mesh, t), Vec3(0, -1, 0));
  // 130 by 105 millimetres.
  double area = 0;
  for (const auto& t : light.mesh->triangles)
    area += 0.5 * glm::length(glm::cross(light.mesh->positions[t[1]] - light.mesh->positions[t[0]],
                                         light.mesh->positions[t[2]] - light.mesh->positions[t[0]]));
  EXPECT_NEAR(area, 1.3 * 1.05, 1e-5);
}

TEST(Cornell, CameraAsPublished) {
  const auto camera = scene::choose_camera(scene::cornell_box(), "");
  ASSERT_TRUE(camera);
  EXPECT_LT(glm::distance(Vec3(camera->to_world[3]), Vec3(2.78f, 2.73f, -8)), 1e-5f);
  EXPECT_LT(glm::distance(-Vec3(camera->to_world[2]), Vec3(0, 0, 1)), 1e-6f);
  EXPECT_NEAR(std::tan(camera->yfov / 2), 12.5f / 35, 1e-6f);
  EXPECT_EQ(camera->aspect, 1);
  // The camera looks along +z, so +x, where the red wall is, is on the left.
  EXPECT_LT(camera->to_world[0].x, 0);
}

class EveryBuiltin : public testing::TestWithParam<size_t> {
 protected:
  const scene::Builtin& builtin = scene::builtins()[GetParam()];
  scene::Scene scene = builtin.make();
};
INSTANTIATE_TEST_SUITE_P(Scenes, EveryBuiltin, testing::Range<size_t>(0, scene::builtins().size()),
                         [](const auto& parameter) {
                           std::string name = scene::builtins()[parameter.param].name;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

TEST_P(EveryBuiltin, IsSmallAndLitAndHasAPinholeCamera) {
  const auto cameras = scene::placed_cameras(scene);
  ASSERT_EQ(cameras.size(), 1U);
  EXPECT_EQ(cameras[0].lens_radius, 0);
  const auto compiled = scene::compile(std::make_shared<const scene::Scene>(scene), cameras[0], nullptr);
  EXPECT_LE(compiled->triangle_count(), 50'000U);
  EXPECT_TRUE(compiled->lights().size() > 0 || compiled->solids().any_medium_emits());
  // Only the cloud is outdoors.
  EXPECT_EQ(scene.environment.black(), std::string(builtin.name) != "cloud");
  EXPECT_TRUE(scene.warnings.empty());
  EXPECT_NE(std::string(builtin.doc).back(), '.');
}

TEST_P(EveryBuiltin, NamesAllNodesAndUsesAllMeshesAndMaterials) {
  std::set<int> meshes, materials;
  for (const auto& node : scene.nodes) {
    EXPECT_FALSE(node.name.empty());
    if (node.mesh < 0) continue;
    EXPECT_TRUE(meshes.insert(node.mesh).second) << node.name;
    materials.insert(scene.meshes[static_cast<size_t>(node.mesh)].primitives[0].material);
  }
  EXPECT_EQ(meshes.size(), scene.meshes.size());
  EXPECT_EQ(materials.size(), scene.materials.size());
  std::set<std::string> names;
  for (const auto& m : scene.materials) EXPECT_TRUE(names.insert(m.name).second) << m.name;
}

TEST_P(EveryBuiltin, HasNormalsOnTheSideOfItsTriangles) {
  for (const auto& group : scene.meshes) {
    const Mesh& mesh = *group.primitives[0].mesh;
    EXPECT_GT(mesh.positions.capacity(), mesh.positions.size()) << group.name;
    for (const Vec3& p : mesh.positions) ASSERT_TRUE(is_finite(p)) << group.name;
    for (const auto& t : mesh.triangles) {
      const Vec3 n = normal(mesh, t);
      ASSERT_NEAR(glm::length(n), 1, 1e-4f) << group.name;
      for (const uint32_t v : t)
        if (!mesh.normals.empty()) {
          ASSERT_NEAR(glm::length(mesh.normals[v]), 1, 1e-5f) << group.name;
          ASSERT_GT(glm::dot(mesh.normals[v], n), 0.9f) << group.name;
        }
    }
  }
}

// In a closed mesh every edge occurs once in each direction. Vertices at the same position are equal.
TEST_P(EveryBuiltin, HasClosedGlassMeshes) {
  using Place = std::array<float, 3>;
  for (const auto& group : scene.meshes) {
    const Mesh& mesh = *group.primitives[0].mesh;
    if (!scene.materials[static_cast<size_t>(group.primitives[0].material)].is_solid()) continue;
    std::map<std::pair<Place, Place>, int> edges;
    const auto place = [&](uint32_t v) {
      const Vec3 p = mesh.positions[v];
      return Place{p.x, p.y, p.z};
    };
    for (const auto& t : mesh.triangles)
      for (size_t i = 0; i < 3; ++i) ++edges[{place(t[i]), place(t[(i + 1) % 3])}];
    for (const auto& [edge, count] : edges) {
      ASSERT_EQ(count, 1) << group.name;
      ASSERT_EQ(edges.count({edge.second, edge.first}), 1U) << group.name;
    }
    // The orientation is outwards: the signed volume is positive.
    double volume = 0;
    for (const auto& t : mesh.triangles)
      volume += glm::dot(mesh.positions[t[0]], glm::cross(mesh.positions[t[1]], mesh.positions[t[2]])) / 6;
    EXPECT_GT(volume, 0) << group.name;
  }
}

TEST_P(EveryBuiltin, IsDeterministic) {
  const scene::Scene again = builtin.make();
  EXPECT_EQ(scene.nodes, again.nodes);
  EXPECT_EQ(scene.materials, again.materials);
  EXPECT_EQ(scene.lights, again.lights);
  EXPECT_EQ(scene.cameras, again.cameras);
  ASSERT_EQ(scene.meshes.size(), again.meshes.size());
  for (size_t i = 0; i < scene.meshes.size(); ++i) {
    const Mesh &a = *scene.meshes[i].primitives[0].mesh, &b = *again.meshes[i].primitives[0].mesh;
    EXPECT_EQ(a.positions, b.positions);
    EXPECT_EQ(a.normals, b.normals);
    EXPECT_EQ(a.triangles, b.triangles);
  }
}

render::Document small(const char* name, const char* paths) {
  auto d = *render::new_document(name);
  d.width = d.height = 32;
  d.method.paths = paths;
  return d;
}

double share(const char* name, const char* paths) {
  constexpr uint32_t kSamples = 256;
  return test::mean_of(test::rendered(small(name, paths), kSamples)).value /
         test::mean_of(test::rendered(small(name, ""), kSamples)).value;
}

// The seed is fixed. The shares of rare paths have a relative error of about one third.
TEST(Builtin, ReceivesLightAlongItsCharacteristicPaths) {
  EXPECT_GT(share("cornell-spheres", "EDS+L"), 0.005);
  EXPECT_GT(share("cornell-spheres", "ES+.*L"), 0.05);
  EXPECT_GT(share("glossy-plates", "EGL"), 0.1);
  EXPECT_GT(share("glass-caustic", "EDS+L"), 0.02);
  EXPECT_GT(share("caustic-pool", "ES+DS+L"), 0.2);
  EXPECT_GT(share("spot-indirect", "EDD+L"), 0.2);
  EXPECT_GT(share("door-ajar", "EDD+L"), 0.2);
}

// Surfaces under water are lit and seen only through the water surface.
TEST(Builtin, PoolHasNoDirectLight) {
  auto d = small("caustic-pool", "EDL");
  auto scene = *d.scene;
  for (auto& node : scene.nodes)
    node.visible = node.name == "light" || node.name == "water" || node.name.ends_with("tiles");
  d.scene = std::make_shared<const scene::Scene>(std::move(scene));
  EXPECT_EQ(test::mean_of(test::rendered(d, 4)).value, 0);
}

TEST(Builtin, DoorAjarHasNoDirectLightInTheFrontRoom) {
  // The only directly lit pixels show the next room through the gap.
  const film::Film direct = test::rendered(small("door-ajar", "E(D|G)L"), 16);
  int lit = 0;
  for (int y = 0; y < direct.height(); ++y)
    for (int x = 0; x < direct.width(); ++x) lit += direct.mean(x, y) != Rgb(0) ? 1 : 0;
  EXPECT_GT(lit, 0);
  EXPECT_LT(lit, 100) << "of 1024 pixels";
}

TEST(Builtin, DoorAjarIsDarkWithAClosedDoor) {
  auto d = small("door-ajar", "");
  auto scene = *d.scene;
  for (auto& node : scene.nodes)
    if (node.name == "door") node.transform = {.translation = {1.05f, 1.025f, -0.12f}};
  d.scene = std::make_shared<const scene::Scene>(std::move(scene));
  EXPECT_EQ(test::mean_of(test::rendered(d, 64)).value, 0);
}

TEST(Load, ByNameOrFile) {
  const auto box = scene::load("cornell");
  ASSERT_TRUE(box);
  EXPECT_EQ(box->file, "");
  const auto missing = scene::load("/nowhere/scene.glb");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().message, "/nowhere/scene.glb: there is no such file");
}

TEST(Load, AnUnknownNameListsTheKnownOnes) {
  for (const auto& builtin : scene::builtins()) {
    EXPECT_EQ(scene::find_builtin(builtin.name), &builtin);
    EXPECT_TRUE(scene::load(builtin.name));
    EXPECT_NE(scene::load("corner").error().message.find(builtin.name), std::string::npos);
  }
}

}  // namespace
}  // namespace etendue
