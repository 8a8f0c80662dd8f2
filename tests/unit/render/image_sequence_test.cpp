// Sequences of images: names of files, turns of the camera, ranges of frames.
#include "render/image_sequence.h"

#include <gtest/gtest.h>

#include "scene/compiled_scene.h"
#include "support/scenes.h"

namespace etendue {
namespace {

TEST(ImageSequence, NamesOfFiles) {
  EXPECT_EQ(render::frame_file("box.exr", 12), "box.0012.exr");
  EXPECT_EQ(render::frame_file("box.exr", 123456), "box.123456.exr");
  EXPECT_EQ(render::frame_file("a/b.c/box", 3), "a/b.c/box.0003");
  EXPECT_EQ(render::frame_file("a#b/box-##.png", 7), "a#b/box-07.png");
  EXPECT_EQ(render::frame_file("a#b/box.png", 7), "a#b/box.0007.png");
  EXPECT_EQ(render::frame_file("#.png", 10), "10.png");
}

TEST(ImageSequence, RangesOfFrames) {
  EXPECT_EQ(render::parse_frames("3:10")->first, 3u);
  EXPECT_EQ(render::parse_frames("3:10")->end, 10u);
  EXPECT_EQ(render::parse_frames("8")->count(), 8u);
  for (const char* wrong : {"", ":", "3:", ":3", "3:3", "4:3", "-1:3", "1:2:3", "a:b", "0", "1.5", "99999999999"})
    EXPECT_FALSE(render::parse_frames(wrong)) << wrong;
}

TEST(ImageSequence, FrameShowsItsTime) {
  const auto frame = render::animation_frame(test::cornell(16), 12, 24);
  EXPECT_EQ(frame->scene->time, 0.5f);
}

// A quarter of a turn counterclockwise maps the offset (x, y, z) to (z, y, -x).
TEST(ImageSequence, QuarterTurn) {
  auto d = test::cornell(16);
  const Vec3 centre(0.25f, 0.5f, -1);
  d.camera = look_at({2.25f, 1.5f, 3}, centre, {0, 1, 0}, 0.7f);
  const auto turned = render::turned_about(d, centre, M_PI / 2);
  const Vec3 offset = Vec3(d.camera.to_world[3]) - centre, moved = Vec3(turned.camera.to_world[3]) - centre;
  EXPECT_NEAR(moved.x, offset.z, 1e-6f);
  EXPECT_NEAR(moved.y, offset.y, 1e-6f);
  EXPECT_NEAR(moved.z, -offset.x, 1e-6f);
  // It still looks at the centre, and stays upright.
  const Vec3 view = -Vec3(turned.camera.to_world[2]);
  EXPECT_NEAR(glm::dot(view, glm::normalize(-moved)), 1, 1e-6f);
  EXPECT_NEAR(turned.camera.to_world[0].y, 0, 1e-6f);
  EXPECT_EQ(turned.camera.yfov, d.camera.yfov);
  EXPECT_EQ(render::turned_about(d, centre, 0).camera, d.camera);
}

TEST(ImageSequence, OrbitCentreIsTheSurfaceInFrontOfTheCamera) {
  auto d = test::cornell(16);
  const auto compiled = scene::compile(d.scene, d.camera, nullptr, d.height);
  const Vec3 centre = render::orbit_centre(d.camera, *compiled);
  const Vec3 eye(d.camera.to_world[3]), view = -Vec3(d.camera.to_world[2]);
  const Hit hit = compiled->intersect({eye, 0, view, kInfinity}, 0);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(glm::length(centre - eye), hit.t, 1e-4f * hit.t);
  d.camera.to_world[2] *= -1.0f;  // looks away from the box
  const Vec3 away = render::orbit_centre(d.camera, *compiled);
  EXPECT_GT(glm::dot(away - eye, -Vec3(d.camera.to_world[2])), 0);
}

}  // namespace
}  // namespace etendue
