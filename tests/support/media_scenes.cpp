#include "support/media_scenes.h"

#include "support/translation.h"

namespace etendue::test {

using render::Document;

namespace {

// Moves a quad to p and turns it to face down.
Mat4 above(const Vec3& p) {
  Mat4 m = at(p);
  m[1][1] = -1;
  m[2][2] = -1;
  return m;
}

void add_area_light(scene::Scene& scene, float half_size, float radiance, const Vec3& p) {
  add(scene, quad(half_size), diffuse(Rgb(0.2f), Rgb(radiance)), above(p));
}

Document seen_from(scene::Scene scene, const Vec3& eye, const Vec3& target, float yfov) {
  return document(std::move(scene), look_at(eye, target, {0, 1, 0}, yfov), kSize, kSize);
}

}  // namespace

Material liquid(float ior, const Rgb& per_metre, float roughness) {
  Material m = scene::glass(ior);
  m.roughness = roughness;
  if (per_metre == Rgb(1)) return m;
  m.attenuation_color = per_metre;
  m.attenuation_distance = 1;
  return m;
}

std::shared_ptr<const Mesh> shell(float outer, float inner, int rings) {
  Mesh mesh = *sphere(outer, rings, false);
  const std::shared_ptr<const Mesh> wall = sphere(inner, rings, true);
  const auto first = static_cast<uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), wall->positions.begin(), wall->positions.end());
  for (const Triangle& t : wall->triangles) mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  mesh.positions.reserve(mesh.positions.size() + 1);
  return std::make_shared<const Mesh>(std::move(mesh));
}

Document stone_in_tinted_water() {
  scene::Scene scene;
  add(scene, scene::box({1, 0.6f, 1}), liquid(1.33f, {0.5f, 0.7f, 0.9f}), at({0, 0.6f, 0}));
  add(scene, sphere(0.4f, 16, false), diffuse({0.8f, 0.7f, 0.5f}), at({0.2f, 0.45f, 0.1f}));
  add(scene, quad(4), diffuse(Rgb(0.6f)), at({0, -0.05f, 0}));
  add_area_light(scene, 1.5f, 3, {0, 3, 0});
  scene.environment.tint = {0.7f, 0.8f, 1.0f};
  return seen_from(std::move(scene), {0, 2.2f, 3.2f}, {0, 0.5f, 0}, 0.7f);
}

Document ice_in_water_in_glass(bool overlapping) {
  constexpr float kWall = 0.9f;
  scene::Scene scene;
  add(scene, shell(1, kWall, 12), liquid(1.5f, {0.9f, 1, 0.9f}), at({0, 1, 0}));
  add(scene, sphere(overlapping ? 0.94f : kWall, 12, false), liquid(1.33f, {0.6f, 0.8f, 1}), at({0, 1, 0}));
  add(scene, sphere(0.45f, 12, false), liquid(1.31f, {1, 0.7f, 0.6f}, 0.3f), at({0.15f, 1.2f, 0.1f}));
  add(scene, quad(4), diffuse(Rgb(0.6f)), at({0, -0.05f, 0}));
  add_area_light(scene, 1.2f, 5, {0.5f, 3.5f, 0.5f});
  scene.environment.tint = {0.7f, 0.8f, 1.0f};
  return seen_from(std::move(scene), {0, 2.2f, 4}, {0, 0.8f, 0}, 0.65f);
}

Document bubble() {
  scene::Scene scene;
  add(scene, sphere(0.8f, 16, false), liquid(1.5f, {0.5f, 0.9f, 0.6f}), at({0, 0.85f, 0}));
  add(scene, sphere(0.4f, 16, false), liquid(1), at({0.2f, 1, 0.1f}));
  add(scene, quad(4), diffuse(Rgb(0.6f)));
  add_area_light(scene, 1, 6, {0.5f, 3, 0.5f});
  scene.environment.tint = {0.7f, 0.8f, 1.0f};
  return seen_from(std::move(scene), {0, 1.8f, 3}, {0, 0.6f, 0}, 0.7f);
}

Document light_in_tinted_water(bool camera_inside) {
  scene::Scene scene;
  add(scene, scene::box({1.5f, 1.2f, 1.5f}), liquid(1.33f, {0.6f, 0.8f, 0.9f}), at({0, 1.2f, 0}));
  add(scene, quad(1.2f), diffuse(Rgb(0.5f)), at({0, 0.1f, 0}));
  add(scene, sphere(0.3f, 12, false), diffuse({0.8f, 0.5f, 0.4f}), at({-0.3f, 0.5f, 0}));
  add_area_light(scene, 0.4f, 12, {0.2f, 2, 0.1f});
  add(scene, sphere(0.2f, 8, false), diffuse(Rgb(0), {2, 3, 6}), at({0.7f, 0.7f, 0.2f}));
  return camera_inside ? seen_from(std::move(scene), {0, 1.4f, 1.3f}, {0, 0.5f, 0}, 1)
                       : seen_from(std::move(scene), {0, 2.2f, 3.4f}, {0, 0.8f, 0}, 0.8f);
}

Document camera_inside_glass() {
  scene::Scene scene;
  add(scene, scene::box(Vec3(2)), liquid(1.5f, {0.8f, 0.9f, 0.7f}));
  add(scene, sphere(0.5f, 16, false), diffuse({0.8f, 0.5f, 0.4f}), at({-0.6f, 0, -0.4f}));
  add(scene, sphere(0.4f, 16, false), liquid(1, Rgb(1), 0.4f), at({0.6f, 0.1f, -0.2f}));
  add(scene, quad(1.5f), diffuse(Rgb(0.6f)), at({0, -0.8f, 0}));
  add_area_light(scene, 0.5f, 8, {0, 1.4f, 0.3f});
  scene.environment.tint = {0.4f, 0.5f, 0.6f};
  return seen_from(std::move(scene), {0, 0.2f, 1.7f}, {0, -0.1f, 0}, 1);
}

}  // namespace etendue::test
