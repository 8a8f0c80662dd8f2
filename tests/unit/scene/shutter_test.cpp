// Motion while the shutter is open: the number of time steps and the positions.
#include "scene/shutter.h"

#include <gtest/gtest.h>

#include "scene/compiled_scene.h"
#include "scene/pose.h"
#include "support/moving_scenes.h"

namespace etendue::scene {
namespace {

using test::animate;

struct Animated {
  Scene scene;
  int node;

  explicit Animated(std::shared_ptr<const Mesh> mesh = test::cube(1, false))
      : node(test::add(scene, std::move(mesh), test::diffuse(Rgb(0.5f)))) {
    scene.nodes[0].transform.matrix.reset();
  }
  const Primitive& primitive() const { return scene.meshes[0].primitives[0]; }
  std::optional<Shutter::Moving> moving(float seconds) const {
    return Shutter(scene, seconds).moving(node, primitive());
  }
  size_t steps(float seconds) const { return moving(seconds)->motion->steps(); }
  Mat4 matrix(float time) const { return world_matrices(scene, time)[static_cast<size_t>(node)]; }
};

Animated turning(float radians) {
  Animated a;
  const Vec4 half = test::turn({0, 1, 0}, radians / 2), whole = test::turn({0, 1, 0}, radians);
  animate(a.scene, a.node, AnimatedPath::rotation, {0, 0.5f, 1},
          {0, 0, 0, 1, half.x, half.y, half.z, half.w, whole.x, whole.y, whole.z, whole.w});
  return a;
}

float farthest_from_truth(const Animated& a, float seconds) {
  const auto moving = a.moving(seconds);
  float worst = 0;
  for (int i = 0; i <= 1000; ++i) {
    const float t = static_cast<float>(i) / 1000;
    for (const Vec3& p : moving->mesh->positions) {
      const Mat4 off = moving->motion->matrix_at(t) - a.matrix(a.scene.time + t * seconds);
      worst = std::max(worst, glm::length(Vec3(off * Vec4(p, 1))));
    }
  }
  return worst;
}

TEST(Shutter, NoMotionIfClosedOrAfterTheAnimation) {
  Animated a = turning(1);
  EXPECT_FALSE(a.moving(0));
  EXPECT_TRUE(a.moving(0.1f));
  a.scene.time = 1;
  EXPECT_FALSE(a.moving(5));
}

TEST(Shutter, LinearMotionHasTwoSteps) {
  Animated a;
  animate(a.scene, a.node, AnimatedPath::translation, {0, 1}, {0, 0, 0, 3, 2, 1});
  EXPECT_EQ(a.steps(1), 2U);
  EXPECT_EQ(a.steps(0.1f), 2U);
}

TEST(Shutter, RotationsHaveMoreSteps) {
  EXPECT_LT(turning(0.1f).steps(1), turning(1).steps(1));
  EXPECT_LT(turning(1).steps(0.1f), turning(1).steps(1));
  EXPECT_EQ(turning(6).steps(1), Motion::kMaxSteps);
  // The bounding box of a rotated cube has a radius of at most sqrt(5).
  for (const float radians : {0.1f, 1.0f, 3.0f}) EXPECT_LT(farthest_from_truth(turning(radians), 1), 2.24f / 4096);
  EXPECT_LT(farthest_from_truth(turning(6), 1), 1e-3f);
}

// A movement that returns to its start between two coarse samples.
TEST(Shutter, ResolvesEveryKeyframe) {
  Animated a;
  animate(a.scene, a.node, AnimatedPath::translation, {0, 0.40f, 0.41f, 0.42f, 0.43f, 1},
          {0, 0, 0, 0, 0, 0, 5, 0, 0, 5, 0, 0, 0, 0, 0, 0, 0, 0});
  EXPECT_EQ(a.steps(1), Motion::kMaxSteps);
  Animated tremble;
  std::vector<float> times, values;
  for (int i = 0; i <= 32; ++i) {
    times.push_back(static_cast<float>(i) / 32);
    values.insert(values.end(), {static_cast<float>(i % 2), 0, 0});
  }
  animate(tremble.scene, tremble.node, AnimatedPath::translation, times, values);
  EXPECT_GE(tremble.steps(1), 33U);
  EXPECT_LT(farthest_from_truth(tremble, 1), 1e-5f);
}

TEST(Shutter, ChildrenMoveWithTheirParents) {
  Animated a;
  a.scene.nodes.emplace_back();
  a.scene.nodes[1].children = {0};
  a.scene.nodes[0].parent = 1;
  a.scene.roots = {1};
  animate(a.scene, 1, AnimatedPath::translation, {0, 1}, {0, 0, 0, 1, 0, 0});
  EXPECT_TRUE(a.moving(1));
}

TEST(Shutter, TemporarilySingularNodesDeform) {
  Animated a;
  animate(a.scene, a.node, AnimatedPath::scale, {0, 1}, {0, 0, 0, 1, 1, 1});
  const auto moving = a.moving(1);
  ASSERT_TRUE(moving);
  ASSERT_TRUE(moving->motion->deforms());
  EXPECT_EQ(moving->motion->steps(), 2U);
  EXPECT_EQ(moving->motion->vertices[1].positions, a.primitive().mesh->positions);
  // A node that is singular at all times is not rendered.
  Animated flat;
  animate(flat.scene, flat.node, AnimatedPath::translation, {0, 1}, {0, 0, 0, 1, 1, 1});
  flat.scene.nodes[0].transform.scale = {1, 0, 1};
  EXPECT_FALSE(flat.moving(1));
}

// A nonlinear morph: the weights of two targets in succession.
TEST(Shutter, DeformationIsInWorldSpace) {
  Animated a(test::sphere(1, 8, false));
  const size_t n = a.primitive().mesh->positions.size();
  auto deformation = std::make_shared<Deformation>();
  deformation->targets.push_back({std::vector<Vec3>(n, Vec3(1, 0, 0)), {}, {}});
  a.scene.meshes[0].primitives[0].deformation = deformation;
  a.scene.meshes[0].weights = {0};
  a.scene.nodes[0].transform.translation = {0, 2, 0};
  animate(a.scene, a.node, AnimatedPath::weights, {0, 1}, {0, 1});
  animate(a.scene, a.node, AnimatedPath::rotation, {0, 1}, {0, 0, 0, 1, 0, 1, 0, 0});
  const auto moving = a.moving(1);
  ASSERT_TRUE(moving && moving->motion->deforms());
  EXPECT_GT(moving->motion->steps(), 8U);
  const auto world = world_matrices(a.scene, 1);
  const auto last = in_world(deformed_mesh(a.scene, a.node, a.primitive(), world, 1), world[0]);
  EXPECT_EQ(moving->motion->vertices.back().positions, last->positions);
}

TEST(Shutter, CamerasMoveWithTheirNode) {
  Scene scene;
  const int eye = test::add_camera(scene, look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 1));
  animate(scene, eye, AnimatedPath::translation, {0, 1}, {0, 0, 5, 1, 0, 5});
  Camera camera = placed_cameras(scene)[0];
  const auto motion = Shutter(scene, 0.5f).motion_of(camera);
  ASSERT_TRUE(motion);
  EXPECT_LT(glm::distance(Vec3(motion->at(1)[3]), Vec3(0.5f, 0, 5)), 1e-6f);
  EXPECT_FALSE(Shutter(scene, 0).motion_of(camera));
  camera.to_world[3].x += 0.1f;
  EXPECT_FALSE(Shutter(scene, 0.5f).motion_of(camera)) << "moved away from its node";
}

TEST(Shutter, RebuildsOnlyWhatItChanges) {
  Animated a = turning(1);
  const auto scene = std::make_shared<const Scene>(a.scene);
  Camera camera = look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 1);
  const auto still = compile(scene, camera, nullptr);
  EXPECT_EQ(still->moving(), "");
  camera.shutter = 0.5f;
  const auto moving = compile(scene, camera, still);
  EXPECT_TRUE(moving->report().top_level_built);
  EXPECT_EQ(moving->moving(), "node 0");
  camera.to_world[3].x = 1;
  const auto elsewhere = compile(scene, camera, moving);
  EXPECT_FALSE(elsewhere->report().top_level_built);
  EXPECT_EQ(elsewhere->moving(), "node 0");
  camera.shutter = 0;
  EXPECT_EQ(compile(scene, camera, elsewhere)->moving(), "");
}

}  // namespace
}  // namespace etendue::scene
