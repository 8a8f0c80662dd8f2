// Keyframes that are set by the user.
#include "scene/keyframes.h"

#include <gtest/gtest.h>

#include "render/document.h"
#include "scene/animation.h"
#include "scene/builtin/builtin.h"
#include "scene/gltf/load_gltf.h"
#include "scene/gltf/save_gltf.h"
#include "scene/pose.h"
#include "scene/structural_edit.h"

namespace etendue::scene {
namespace {

constexpr int kNode = 1;

Transform at(float x) {
  Transform t;
  t.translation = Vec3(x, 2 * x, 0);
  t.scale = Vec3(1 + x);
  return t;
}

Scene with_keys(Scene scene) {
  for (const float time : {2.0f, 0.0f, 1.0f}) {
    const int animation = animation_for_keyframes(scene, kNode);
    auto changed = with_keyframe(std::move(scene), kNode, animation, time, at(time * time));
    EXPECT_TRUE(changed) << changed.error().message;
    scene = std::move(*changed);
  }
  return scene;
}

TEST(Keyframes, ValuesBetweenKeysAreLinear) {
  Scene scene = with_keys(find_builtin("cornell")->make());
  EXPECT_EQ(keyframe_times(scene, kNode, 0), (std::vector<float>{0, 1, 2}));
  EXPECT_FLOAT_EQ(animation_duration(scene), 2);
  for (const auto& [time, x] :
       {std::pair{0.0f, 0.0f}, {0.5f, 0.5f}, {1.0f, 1.0f}, {1.5f, 2.5f}, {2.0f, 4.0f}, {9.0f, 4.0f}}) {
    scene.time = time;
    const Transform posed = posed_transform(scene, kNode);
    EXPECT_NEAR(posed.translation.x, x, 1e-6f) << time;
    EXPECT_NEAR(posed.translation.y, 2 * x, 1e-6f) << time;
    EXPECT_NEAR(posed.scale.z, 1 + x, 1e-6f) << time;
  }
}

TEST(Keyframes, AKeyAtTheSameTimeIsReplacedAndTheLastRemovedKeyEndsTheAnimation) {
  Scene scene = with_keys(find_builtin("cornell")->make());
  scene = *with_keyframe(std::move(scene), kNode, 0, 1 + kKeyframeTolerance / 2, at(7));
  EXPECT_EQ(keyframe_times(scene, kNode, 0).size(), 3U);
  scene.time = 1;
  EXPECT_NEAR(posed_transform(scene, kNode).translation.x, 7, 1e-3f);
  EXPECT_FALSE(without_keyframe(scene, kNode, 0, 0.5f));
  EXPECT_FALSE(without_keyframe(scene, kNode + 1, 0, 1));
  EXPECT_FALSE(without_keyframe(scene, kNode, 1, 1));
  for (const float time : {0.0f, 1.0f, 2.0f}) scene = *without_keyframe(std::move(scene), kNode, 0, time);
  EXPECT_EQ(animation_duration(scene), 0);
  EXPECT_TRUE(scene.animations[0]->channels.empty());
  EXPECT_EQ(posed_transform(scene, kNode), scene.nodes[kNode].transform);
}

TEST(Keyframes, BadKeyframesAreErrors) {
  const Scene scene = find_builtin("cornell")->make();
  const auto is_refused = [&](float time, Transform transform, int node = kNode, int animation = -1) {
    StructuralEdit edit{.kind = EditKind::set_keyframe, .node = node, .transform = transform};
    edit.animation = animation;
    edit.time = time;
    return !with_edit(scene, edit);
  };
  EXPECT_FALSE(is_refused(0, at(1)));
  EXPECT_TRUE(is_refused(-1, at(1)));
  EXPECT_TRUE(is_refused(NAN, at(1)));
  EXPECT_TRUE(is_refused(2 * kLongestAnimation, at(1)));
  EXPECT_TRUE(is_refused(0, at(INFINITY)));
  EXPECT_TRUE(is_refused(0, {.matrix = Mat4(1)}));
  EXPECT_TRUE(is_refused(0, at(1), 12345));
  EXPECT_TRUE(is_refused(0, at(1), -1));
  EXPECT_TRUE(is_refused(0, at(1), kNode, 3));
}

TEST(Keyframes, TheStateRestoresThem) {
  auto document = render::new_document("cornell");
  ASSERT_TRUE(document);
  for (const float time : {0.0f, 1.5f, 1.5f}) {
    StructuralEdit edit{.kind = EditKind::set_keyframe, .node = kNode, .transform = at(time)};
    edit.animation = animation_for_keyframes(*document->scene, kNode);
    edit.time = time;
    document = render::with_structural_edit(*document, edit);
    ASSERT_TRUE(document) << document.error().message;
  }
  EXPECT_EQ(document->structure.size(), 2U) << "the last two edits set the same keyframe";
  document = render::with(*document, "scene.time", Value(0.75));
  const auto restored = render::document_from_state(render::state_json(*document, 0), "test");
  ASSERT_TRUE(restored) << restored.error().message;
  EXPECT_EQ(restored->structure, document->structure);
  EXPECT_EQ(posed_transform(*restored->scene, kNode), posed_transform(*document->scene, kNode));
  EXPECT_NEAR(posed_transform(*restored->scene, kNode).translation.x, 0.75f, 1e-6f);
}

TEST(Keyframes, FilesKeepThem) {
  Scene scene = with_keys(find_builtin("cornell")->make());
  const std::string file = testing::TempDir() + "keyframes.glb";
  ASSERT_TRUE(save_gltf(scene, file));
  const auto loaded = load_gltf(file);
  ASSERT_TRUE(loaded) << loaded.error().message;
  ASSERT_EQ(loaded->animations.size(), 1U);
  EXPECT_FLOAT_EQ(animation_duration(*loaded), 2);
  const auto& channels = loaded->animations[0]->channels;
  ASSERT_EQ(channels.size(), 3U);
  EXPECT_EQ(channels[0].times, (std::vector<float>{0, 1, 2}));
  EXPECT_EQ(channels[0].values, scene.animations[0]->channels[0].values);
  // Without keyframes, there is no animation, which would be invalid.
  for (const float time : {0.0f, 1.0f, 2.0f}) scene = *without_keyframe(std::move(scene), kNode, 0, time);
  ASSERT_TRUE(save_gltf(scene, file));
  const auto still = load_gltf(file);
  ASSERT_TRUE(still) << still.error().message;
  EXPECT_TRUE(still->animations.empty());
}

// A file that animates the translation only. The keyframes that a drag sets one after the other leave no trace of the
// earlier ones, for one object and for two.
TEST(Keyframes, RepeatedOnesAreRestoredAsTheLast) {
  Scene moving = find_builtin("cornell")->make();
  Animation animation{.name = "slide", .channels = {}, .duration = 3};
  animation.channels.push_back({.node = kNode, .times = {0, 3}, .values = {0, 0, 0, 1, 0, 0}});
  moving.animations.push_back(std::make_shared<const Animation>(animation));
  const std::string file = testing::TempDir() + "slide.glb";
  ASSERT_TRUE(save_gltf(moving, file));
  auto document = render::new_document(file);
  ASSERT_TRUE(document) << document.error().message;
  for (const float x : {0.1f, 0.2f, 0.3f})
    for (const int node : {kNode, kNode + 1}) {
      StructuralEdit edit{.kind = EditKind::set_keyframe, .node = node, .transform = at(x)};
      edit.transform.rotation = Vec4(x, 0, 0, 1);
      edit.animation = 0;
      edit.time = 1;
      document = render::with_structural_edit(*document, edit);
      ASSERT_TRUE(document) << document.error().message;
    }
  EXPECT_EQ(document->structure.size(), 2U);
  auto restored = render::document_from_state(render::state_json(*document, 0), "test");
  ASSERT_TRUE(restored) << restored.error().message;
  for (const double time : {0.0, 0.5, 1.0, 2.5, 4.0}) {
    const auto live = render::with(*document, "scene.time", Value(time)),
               again = render::with(*restored, "scene.time", Value(time));
    ASSERT_TRUE(live && again);
    for (const int node : {kNode, kNode + 1})
      EXPECT_EQ(posed_transform(*live->scene, node), posed_transform(*again->scene, node)) << time;
  }
}

// Editing shows the place that the renderer uses.
TEST(Keyframes, ThePosedTransformIsThatOfTheWorldMatrices) {
  Scene scene = with_keys(find_builtin("cornell")->make());
  scene.nodes[kNode].transform = {.matrix = Mat4(2)};
  for (const float time : {0.0f, 0.7f, 5.0f}) {
    scene.time = time;
    EXPECT_EQ(posed_transform(scene, kNode).to_matrix(), world_matrices(scene)[kNode]) << time;
  }
}

}  // namespace
}  // namespace etendue::scene
