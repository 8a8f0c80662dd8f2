// Scenes of many instances, of which an edit moves a few: their rays hit what those of a scene that is compiled anew hit.
#include <gtest/gtest.h>

#include <random>

#include "scene/compiled_scene.h"
#include "support/scenes.h"

namespace etendue {
namespace {

using scene::CompiledScene;
using scene::Scene;
using Compiled = std::shared_ptr<const CompiledScene>;

constexpr int kSide = 22;  // cubes per axis: 10,648 in all

Mat4 at(const Vec3& position) {
  Mat4 m(1);
  m[3] = Vec4(position, 1);
  return m;
}

// A block of small cubes, the last of which is half transparent, in front of a floor and under a light.
Scene block_of_cubes() {
  Scene scene;
  test::add(scene, test::quad(20), test::diffuse(Rgb(0.5f)));
  test::add(scene, test::quad(1), test::diffuse(Rgb(0), Rgb(5)), at({0, 19, 0}));
  Material half = test::diffuse(Rgb(0.5f));
  half.alpha_mode = AlphaMode::blend;
  half.alpha = 0.5f;
  const int first = test::add(scene, test::cube(0.2f, false), test::diffuse(Rgb(0.7f)));
  const int mesh = scene.nodes[static_cast<size_t>(first)].mesh;
  for (int i = 1; i < kSide * kSide * kSide; ++i) {
    scene::Node node;
    node.mesh = mesh;
    node.transform.translation = 0.5f * Vec3(i % kSide, i / kSide % kSide + 4, i / kSide / kSide) - Vec3(5, 0, 5);
    scene.roots.push_back(static_cast<int>(scene.nodes.size()));
    scene.nodes.push_back(node);
  }
  test::add(scene, test::cube(0.3f, false), half, at({0, 1, 0}));
  return scene;
}

Compiled compiled(Scene scene, const Compiled& previous = nullptr) {
  return scene::compile(std::make_shared<const Scene>(std::move(scene)), Camera(), previous);
}

// The scene of `from` after an edit of one node.
Compiled moved(const Compiled& from, size_t node, const Vec3& position) {
  Scene scene = from->description();
  scene.nodes[node].transform = {.matrix = at(position)};
  return compiled(std::move(scene), from);
}

// Packets and single rays between random points around the cubes.
void expect_same_hits(const CompiledScene& a, const CompiledScene& b) {
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_FLOAT_EQ(a.bounds().min[axis], b.bounds().min[axis]);
    EXPECT_FLOAT_EQ(a.bounds().max[axis], b.bounds().max[axis]);
  }
  std::mt19937 random(1);
  std::uniform_real_distribution<float> coordinate(-7, 9);
  size_t hits = 0, blocked = 0;
  for (int p = 0; p < 4000; ++p) {
    RayPacket packet_a, packet_b, shadow_a, shadow_b;
    uint32_t seeds[RayPacket::kSize];
    std::vector<Ray> rays(RayPacket::kSize);
    for (int i = 0; i < RayPacket::kSize; ++i) {
      const Vec3 from(coordinate(random), 4 + coordinate(random), coordinate(random));
      const Vec3 to(coordinate(random), 4 + coordinate(random), coordinate(random));
      seeds[i] = static_cast<uint32_t>(random());
      rays[static_cast<size_t>(i)] = {from, 0, to - from, kInfinity};
      packet_a.set(i, rays[static_cast<size_t>(i)]);
      packet_b.set(i, rays[static_cast<size_t>(i)]);
      Ray segment = rays[static_cast<size_t>(i)];
      segment.tfar = 1;
      shadow_a.set(i, segment);
      shadow_b.set(i, segment);
    }
    a.intersect(packet_a, RayPacket::kSize, false, seeds);
    b.intersect(packet_b, RayPacket::kSize, false, seeds);
    a.occluded(shadow_a, RayPacket::kSize, seeds);
    b.occluded(shadow_b, RayPacket::kSize, seeds);
    for (int i = 0; i < RayPacket::kSize; ++i) {
      ASSERT_EQ(packet_a.has_hit(i), packet_b.has_hit(i));
      ASSERT_EQ(shadow_a.is_occluded(i), shadow_b.is_occluded(i));
      blocked += shadow_a.is_occluded(i);
      if (!packet_a.has_hit(i)) continue;
      Hit x, y;
      packet_a.get(i, x);
      packet_b.get(i, y);
      ASSERT_EQ(x.instance, y.instance);
      ASSERT_EQ(x.triangle, y.triangle);
      ASSERT_NEAR(x.t, y.t, 1e-5f * y.t);
      const Hit single = a.intersect(rays[static_cast<size_t>(i)], seeds[i]);
      ASSERT_EQ(single.instance, y.instance);
      ASSERT_EQ(a.instances()[x.instance].node, b.instances()[x.instance].node);
      ++hits;
    }
  }
  EXPECT_GT(hits, 20'000U);
  EXPECT_GT(blocked, 5'000U);
}

size_t inner_cube() { return 2 + kSide * kSide * (kSide / 2) + kSide * (kSide / 2) + kSide / 2; }

TEST(MovedInstances, HitTheSameAsASceneCompiledAnew) {
  const Compiled first = compiled(block_of_cubes());
  const Compiled once = moved(first, inner_cube(), {0.2f, 1.5f, 0.3f});
  EXPECT_FALSE(once->report().top_level_built || once->report().lights_built || once->report().materials_built);
  EXPECT_EQ(once->report().instances_moved, 1);
  expect_same_hits(*once, *compiled(once->description()));
  const Compiled twice = moved(once, inner_cube() + 1, {1, 1.5f, 1});
  EXPECT_EQ(twice->report().instances_moved, 2);
  const Compiled again = moved(twice, inner_cube(), {2, 5.1f, 0});
  EXPECT_EQ(again->report().instances_moved, 2);
  EXPECT_FALSE(again->report().top_level_built);
  expect_same_hits(*again, *compiled(again->description()));
}

TEST(MovedInstances, UndoRestoresTheHits) {
  const Compiled first = compiled(block_of_cubes());
  const Compiled after = moved(first, inner_cube(), {0.2f, 1.5f, 0.3f});
  const Compiled undone = compiled(first->description(), after);
  EXPECT_FALSE(undone->report().top_level_built);
  expect_same_hits(*undone, *first);
}

// The opacity test gets the number of the instance, and its random numbers.
TEST(MovedInstances, TransparentObjectsStayTransparent) {
  const Compiled first = compiled(block_of_cubes());
  ASSERT_TRUE(first->has_transparency());
  const size_t veil = first->description().nodes.size() - 1;
  const Compiled after = moved(first, veil, {0.6f, 2, 0.4f});
  EXPECT_FALSE(after->report().top_level_built);
  EXPECT_EQ(after->report().meshes_built, 1) << "it was part of the top level";
  expect_same_hits(*after, *compiled(after->description()));
}

// A node takes its children along, but not those that are hidden.
TEST(MovedInstances, ChildrenMoveWithTheirParent) {
  Scene scene = block_of_cubes();
  const auto parent = static_cast<int>(inner_cube());
  for (const int child : {parent + 1, parent + 2}) {
    scene.nodes[static_cast<size_t>(child)].parent = parent;
    scene.nodes[static_cast<size_t>(parent)].children.push_back(child);
    std::erase(scene.roots, child);
  }
  scene.nodes[static_cast<size_t>(parent) + 2].visible = false;
  const Compiled first = compiled(std::move(scene));
  const Compiled after = moved(first, inner_cube(), {0.2f, 1.5f, 0.3f});
  EXPECT_EQ(after->report().instances_moved, 2);
  EXPECT_FALSE(after->report().top_level_built);
  expect_same_hits(*after, *compiled(after->description()));
}

// The place from before determines the bounds.
TEST(MovedInstances, BoundsFollowTheOutermostObject) {
  const Compiled first = compiled(block_of_cubes());
  const Compiled once = moved(first, 0, {0, -1, 0});
  EXPECT_FALSE(once->report().top_level_built);
  EXPECT_TRUE(once->report().lights_built) << "the choice of lights knows the bounds";
  expect_same_hits(*once, *compiled(once->description()));
  const Compiled twice = moved(once, 0, {0, 3, 0});
  EXPECT_FALSE(twice->report().top_level_built);
  expect_same_hits(*twice, *compiled(twice->description()));
  EXPECT_GT(twice->bounds().min.y, -0.5f);
}

// The atmosphere is a sphere about the centre of the bounds.
TEST(MovedInstances, AtmosphereFollowsTheBounds) {
  Scene scene = block_of_cubes();
  scene.atmosphere.medium.scattering = Rgb(0.01f);
  scene.atmosphere.radius = 100;
  const Compiled first = compiled(std::move(scene));
  ASSERT_TRUE(first->solids().atmosphere());
  const Compiled after = moved(first, 0, {0, -6, 0}), fresh = compiled(after->description());
  EXPECT_FALSE(after->report().top_level_built);
  EXPECT_NE(after->solids().atmosphere()->centre, first->solids().atmosphere()->centre);
  EXPECT_EQ(after->solids().atmosphere()->centre, fresh->solids().atmosphere()->centre);
}

TEST(MovedInstances, LightsAndSolidsGetANewTopLevel) {
  Scene scene = block_of_cubes();
  Material green = scene::glass();
  green.attenuation_color = Rgb(0.2f, 0.8f, 0.2f);
  green.attenuation_distance = 1;
  const auto solid = static_cast<size_t>(test::add(scene, test::cube(0.2f, false), green, at({1, 1, 1})));
  const Compiled first = compiled(std::move(scene));
  ASSERT_FALSE(first->solids().empty());
  const Compiled light = moved(first, 1, {0.5f, -1, 0});
  EXPECT_TRUE(light->report().top_level_built && light->report().lights_built);
  expect_same_hits(*light, *compiled(light->description()));
  const Compiled moved_glass = moved(light, solid, {1, 1.2f, 1});
  EXPECT_TRUE(moved_glass->report().top_level_built);
  expect_same_hits(*moved_glass, *compiled(moved_glass->description()));
  EXPECT_EQ(moved_glass->solids().containing(moved_glass->instances(), {1, 1.25f, 1}, 0).solids().size(), 1U);
}

// An edit of the material in the same step.
TEST(MovedInstances, EmissionAndPlaceChangeTogether) {
  const Compiled first = compiled(block_of_cubes());
  const size_t veil = first->description().nodes.size() - 1;
  Scene scene = first->description();
  scene.nodes[veil].transform.matrix = at({0.6f, 2, 0.4f});
  scene.materials[static_cast<size_t>(scene.meshes.back().primitives[0].material)].emission = Rgb(2);
  const Compiled after = compiled(std::move(scene), first), fresh = compiled(after->description());
  EXPECT_TRUE(after->report().lights_built);
  ASSERT_EQ(after->lights().triangles().size(), fresh->lights().triangles().size());
  for (size_t i = 0; i < fresh->lights().triangles().size(); ++i)
    EXPECT_EQ(after->lights().triangles()[i].p0, fresh->lights().triangles()[i].p0) << i;
  expect_same_hits(*after, *fresh);
}

}  // namespace
}  // namespace etendue
