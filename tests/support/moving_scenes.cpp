#include "support/moving_scenes.h"

#include <utility>

#include "support/independent_estimates.h"

namespace etendue::test {

using scene::AnimatedPath;

void animate(scene::Scene& scene, int node, AnimatedPath path, std::vector<float> seconds, std::vector<float> values) {
  scene::AnimationChannel channel;
  channel.node = node;
  channel.path = path;
  channel.components = values.size() / seconds.size();
  channel.times = std::move(seconds);
  channel.values = std::move(values);
  auto animation = std::make_shared<scene::Animation>();
  animation->duration = channel.times.back();
  animation->channels.push_back(std::move(channel));
  scene.animations.push_back(std::move(animation));
}

Vec4 turn(const Vec3& axis, float radians) { return Vec4(axis * std::sin(radians / 2), std::cos(radians / 2)); }

int add_camera(scene::Scene& scene, const Camera& camera) {
  scene.cameras.push_back(camera);
  scene::Node node;
  node.camera = static_cast<int>(scene.cameras.size()) - 1;
  node.transform.matrix = camera.to_world;
  scene.nodes.push_back(node);
  scene.roots.push_back(static_cast<int>(scene.nodes.size()) - 1);
  return scene.roots.back();
}

render::Document from_scene_camera(scene::Scene scene, int size) {
  const Camera camera = scene::placed_cameras(scene).front();
  return document(std::move(scene), camera, size, size);
}

render::Document motion_and_lens_scene() {
  scene::Scene scene;
  add(scene, quad(4), diffuse(Rgb(0.6f)));
  Material clay;
  clay.base_color = {0.7f, 0.3f, 0.2f};
  clay.metallic = 0;
  clay.roughness = 0.3f;
  const int ball = add(scene, sphere(0.6f, 16, false), clay);
  animate(scene, ball, AnimatedPath::translation, {0, 0.5f, 1}, {-1.5f, 0.7f, 0, -0.4f, 0.9f, 0, -0.8f, 1.4f, 0});
  const int box = add(scene, cube(0.4f, false), diffuse({0.2f, 0.5f, 0.8f}));
  scene.nodes[static_cast<size_t>(box)].transform = {{1, 0.6f, 0}};
  const Vec4 turned = turn({0, 1, 0}, 2);
  animate(scene, box, AnimatedPath::rotation, {0, 1}, {0, 0, 0, 1, turned.x, turned.y, turned.z, turned.w});
  // Turned upside down, so that it emits downwards.
  const int light = add(scene, quad(0.5f), diffuse(Rgb(0), Rgb(20)));
  scene.nodes[static_cast<size_t>(light)].transform = {{0, 0, 0}, turn({1, 0, 0}, kPi)};
  animate(scene, light, AnimatedPath::translation, {0, 1}, {-1.5f, 2.5f, 1, 1.5f, 2.2f, 1});
  scene.environment.tint = {0.1f, 0.12f, 0.15f};
  const int eye = add_camera(scene, look_at({0, 2, 5}, {0, 0.4f, 0}, {0, 1, 0}, 0.8f));
  animate(scene, eye, AnimatedPath::translation, {0, 1}, {-0.3f, 2, 5, 0.3f, 2, 4.7f});
  const Vec4 down = turn({1, 0, 0}, -0.35f), down_and_aside = turn({1, 0, 0}, -0.3f);
  animate(scene, eye, AnimatedPath::rotation, {0, 1},
          {down.x, down.y, down.z, down.w, down_and_aside.x, down_and_aside.y, down_and_aside.z, down_and_aside.w});
  auto d = from_scene_camera(std::move(scene), kSize);
  d.camera.shutter = 1;
  d.camera.lens_radius = 0.15f;
  d.camera.focus_distance = 4;
  return d;
}

}  // namespace etendue::test
