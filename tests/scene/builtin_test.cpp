// The Cornell box stands as it was published.
#include "scene/builtin.h"

#include <gtest/gtest.h>

namespace etendue {
namespace {

// The mesh that the node of this name shows, and its material.
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
    EXPECT_EQ(p.mesh->triangles.size(), 10U) << "nothing stands on the floor upside down";
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
  // Seen from there +x is on the left, where the red wall stands.
  EXPECT_LT(camera->to_world[0].x, 0);
}

TEST(Load, ByNameOrFile) {
  const auto box = scene::load("cornell");
  ASSERT_TRUE(box);
  EXPECT_EQ(box->file, "");
  const auto missing = scene::load("/nowhere/scene.glb");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().message, "/nowhere/scene.glb: there is no such file");
}

}  // namespace
}  // namespace etendue
