// Solids of a scene: their number and priority, the solids that contain a point, and interfaces that rays find.
#include <gtest/gtest.h>

#include "scene/builtin/shapes.h"
#include "scene/compiled_scene.h"
#include "support/translation.h"

namespace etendue::scene {
namespace {

using test::at;

Material tinted(float ior) {
  Material m = glass(ior);
  m.attenuation_color = {0.5f, 0.6f, 0.7f};
  m.attenuation_distance = 1;
  return m;
}

std::shared_ptr<const CompiledScene> compiled(const Scene& scene, const Camera& camera = {}) {
  return compile(std::make_shared<const Scene>(scene), camera, nullptr);
}

MediumStack stack_of(std::initializer_list<uint32_t> solids) {
  MediumStack stack;
  for (const uint32_t solid : solids) stack.insert(solid);
  return stack;
}

MediumStack solids_at(const CompiledScene& scene, const Vec3& point) {
  return scene.solids().containing(scene.instances(), point, 0);
}

TEST(Solids, IsolatedClearSolidsAreLeftOut) {
  Scene scene;
  add(scene, sphere(1, 8, false), glass(), at({-3, 0, 0}));
  add(scene, sphere(1, 8, false), glass(), at({3, 0, 0}));
  EXPECT_TRUE(compiled(scene)->solids().empty());
  Scene absorbing = scene;
  add(absorbing, sphere(1, 8, false), tinted(1.5f), at({9, 0, 0}));
  EXPECT_EQ(compiled(absorbing)->solids().size(), 1U);
  Scene meeting = scene;
  add(meeting, sphere(1, 8, false), glass(), at({4, 0, 0}));
  EXPECT_EQ(compiled(meeting)->solids().size(), 2U);
  Material thin = tinted(1.5f);
  thin.thickness = 0;
  Scene walls = scene;
  add(walls, sphere(1, 8, false), thin);
  EXPECT_TRUE(compiled(walls)->solids().empty());
}

TEST(Solids, PriorityFollowsBoundsThenFileOrder) {
  Scene scene;
  add(scene, sphere(2, 8, false), glass(1.5f));
  add(scene, sphere(1, 8, false), glass(1.2f));
  add(scene, sphere(1, 8, false), glass(1.3f));
  add(scene, sphere(0.5f, 8, false), glass(1.4f));
  const auto c = compiled(scene);
  ASSERT_EQ(c->solids().size(), 4U);
  const float expected[] = {1.4f, 1.2f, 1.3f, 1.5f};
  for (uint32_t i = 0; i < 4; ++i) EXPECT_EQ(c->solids()[i].eta, expected[i]);
}

// The bounds of an open water surface have no volume. Its priority must still be below that of a ball in the water.
TEST(Solids, PriorityUsesTheAreaOfTheBounds) {
  Scene scene;
  add(scene, quad(10), tinted(1.33f));
  add(scene, sphere(1, 8, false), glass(1.5f));
  const auto c = compiled(scene);
  ASSERT_EQ(c->solids().size(), 2U);
  EXPECT_EQ(c->solids()[0].eta, 1.5f);
}

TEST(Solids, PrimitivesOfANodeWithEqualInteriorsAreOneSolid) {
  Scene scene;
  add(scene, sphere(1, 8, false), tinted(1.5f));
  scene.materials.push_back(tinted(1.5f));
  scene.materials.push_back(tinted(1.7f));
  scene.materials[1].base_color = {0.5f, 1, 1};
  Primitive wall = scene.meshes[0].primitives[0], other = wall;
  wall.material = 1;
  other.material = 2;
  wall.mesh = sphere(0.8f, 8, true);
  other.mesh = sphere(0.2f, 8, false);
  scene.meshes[0].primitives.push_back(wall);
  scene.meshes[0].primitives.push_back(other);
  const auto c = compiled(scene);
  ASSERT_EQ(c->solids().size(), 2U);
  EXPECT_EQ(c->instances()[0].solid, c->instances()[1].solid);
  EXPECT_EQ(c->solids()[c->instances()[2].solid].eta, 1.7f);
  EXPECT_EQ(solids_at(*c, {0.9f, 0, 0}), stack_of({1}));
  EXPECT_EQ(solids_at(*c, {0.5f, 0, 0}), MediumStack());
  EXPECT_EQ(solids_at(*c, {0, 0.1f, 0}), stack_of({0}));
}

TEST(Solids, BsdfModelsDefineTheIndex) {
  Scene scene;
  Material model;
  model.model.model = make_bsdf_model("dielectric")->with("eta", 1.7);
  model.attenuation_color = Rgb(0.5f);
  model.attenuation_distance = 1;
  add(scene, sphere(1, 8, false), model);
  const auto c = compiled(scene);
  ASSERT_EQ(c->solids().size(), 1U);
  EXPECT_EQ(c->solids()[0].eta, 1.7f);
}

// Includes instances and mirrored instances.
TEST(Solids, ContainingAPoint) {
  Scene scene;
  add(scene, sphere(3, 16, false), glass(1.33f));
  add(scene, sphere(1, 16, false), glass(1.5f), at({1, 0, 0}));
  Node twin = scene.nodes.back();
  Mat4 mirrored = at({-1, 0, 0});
  mirrored[0][0] = -1;
  twin.transform.matrix = mirrored;
  scene.nodes.push_back(twin);
  scene.roots.push_back(2);
  const auto c = compiled(scene);
  ASSERT_EQ(c->solids().size(), 3U);
  EXPECT_EQ(solids_at(*c, {1, 0.5f, 0}), stack_of({0, 2}));
  EXPECT_EQ(solids_at(*c, {-1, 0.5f, 0}), stack_of({1, 2}));
  EXPECT_EQ(solids_at(*c, {0, 0, 2}), stack_of({2}));
  EXPECT_EQ(solids_at(*c, {0, 0, 5}), MediumStack());
  EXPECT_EQ(c->solids().containing(c->instances(), {1, 0.5f, 0}, 0, 0), stack_of({2}));
}

TEST(Solids, ContainingTheCamera) {
  Scene scene;
  add(scene, sphere(1, 16, false), tinted(1.5f));
  Camera camera;
  camera.to_world = at({0, 0, 0.5f});
  Ray ray;
  ray.origin = {0, 0, 0.5f};
  ray.direction = {0, 0, -1};
  EXPECT_EQ(compiled(scene, camera)->media_at_camera(ray, 0), stack_of({0}));
  // Rays that start on the near plane start outside the ball.
  camera.near_clip = 2;
  ray.tnear = 2;
  EXPECT_EQ(compiled(scene, camera)->media_at_camera(ray, 0), MediumStack());
  camera.near_clip = 0;
  ray.tnear = 0;
  // A lens partly outside the ball.
  camera.lens_radius = 2;
  ray.origin = {1.5f, 0, 0.5f};
  EXPECT_EQ(compiled(scene, camera)->media_at_camera(ray, 0), MediumStack());
  ray.origin = {0.3f, 0, 0.5f};
  EXPECT_EQ(compiled(scene, camera)->media_at_camera(ray, 0), stack_of({0}));
}

// Boundaries inside a solid of higher priority are skipped.
TEST(Interfaces, InsideAHigherPriorityAreSkipped) {
  Scene scene;
  add(scene, sphere(2, 16, false), glass(1.33f));
  add(scene, sphere(1, 16, false), glass(1.5f), at({1.5f, 0, 0}));
  const auto c = compiled(scene);
  Ray ray;
  ray.origin = {1.3f, 0.1f, 0};
  ray.direction = {1, 0, 0};
  Hit hit = c->intersect(ray, 0);
  ASSERT_EQ(c->instances()[hit.instance].solid, 1U);
  MediumInterface found;
  EXPECT_FALSE(c->find_interface(stack_of({0, 1}), 0, hit, found));
  EXPECT_EQ(found.side(true), stack_of({0}));
  ray.origin = {-1, 0.1f, 0};
  hit = c->intersect(ray, 0);
  ASSERT_EQ(c->instances()[hit.instance].solid, 0U);
  EXPECT_TRUE(c->find_interface(stack_of({1}), 0, hit, found));
  EXPECT_EQ(found.top(true), 1U);
  EXPECT_EQ(found.top(false), 0U);
}

// Touching faces are one interface, on the boundary of the higher priority, from either side.
TEST(Interfaces, TouchingFacesAreOne) {
  Scene scene;
  add(scene, cube(1, false), glass(1.33f), at({-1, 0, 0}));
  add(scene, box({0.5f, 1, 1}), glass(1.5f), at({0.5f, 0, 0}));
  const auto c = compiled(scene);
  for (const float side : {-1.0f, 1.0f}) {
    Ray ray;
    ray.origin = {-0.3f * side, 0.1f, 0.2f};
    ray.direction = {side, 0, 0};
    Hit hit = c->intersect(ray, 0);
    MediumInterface found;
    ASSERT_TRUE(c->find_interface(stack_of({side > 0 ? 1U : 0U}), 0, hit, found));
    EXPECT_EQ(c->instances()[hit.instance].solid, 0U);
    EXPECT_EQ(found.side(true), stack_of({1}));
    EXPECT_EQ(found.side(false), stack_of({0}));
    EXPECT_NEAR(hit.t, 0.3f, 1e-5f);
  }
}

TEST(Solids, UnrelatedEditsReuseThem) {
  Scene scene;
  add(scene, sphere(1, 8, false), tinted(1.5f));
  const auto first = compiled(scene);
  Camera moved;
  moved.to_world = at({0, 0, 5});
  const auto camera = compile(std::make_shared<const Scene>(scene), moved, first);
  EXPECT_EQ(&camera->solids(), &first->solids());
  EXPECT_TRUE(camera->same_light(*first));
  Scene rough = scene;
  rough.materials[0].roughness = 0.5f;
  EXPECT_EQ(&compile(std::make_shared<const Scene>(rough), moved, first)->solids(), &first->solids());
  Scene denser = scene;
  denser.materials[0].ior = 1.8f;
  EXPECT_EQ(compile(std::make_shared<const Scene>(denser), moved, first)->solids()[0].eta, 1.8f);
  Scene clear = scene;
  clear.materials[0] = glass();
  const auto without = compile(std::make_shared<const Scene>(clear), moved, first);
  EXPECT_TRUE(without->solids().empty());
  EXPECT_EQ(without->instances()[0].solid, kNoSolid);
}

}  // namespace
}  // namespace etendue::scene
