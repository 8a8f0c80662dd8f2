#include "support/scattering_scenes.h"

#include "support/translation.h"

namespace etendue::test {

using render::Document;
using scene::Transform;

namespace {

void add_area_light(scene::Scene& scene, float half_size, float radiance, const Vec3& p) {
  Mat4 down = at(p);
  down[1][1] = -1;
  down[2][2] = -1;
  add(scene, quad(half_size), diffuse(Rgb(0.2f), Rgb(radiance)), down);
}

Document seen_from(scene::Scene scene, const Vec3& eye, const Vec3& target, float yfov) {
  return document(std::move(scene), look_at(eye, target, {0, 1, 0}, yfov), kSize, kSize);
}

}  // namespace

MediumDescription medium(const Rgb& scattering, const Rgb& absorption, float g) {
  MediumDescription m{scattering, absorption, {}};
  if (g != 0) m.phase.function = make_phase_function("henyey-greenstein")->with("g", double{g});
  return m;
}

Material medium_boundary(const MediumDescription& inside) {
  Material m;
  m.name = "boundary";
  m.boundary_only = true;
  m.medium = inside;
  return m;
}

Material turbid_liquid(float ior, const MediumDescription& inside, float roughness) {
  Material m = liquid(ior, Rgb(1), roughness);
  m.medium = inside;
  return m;
}

render::Document with_clear_medium(const render::Document& plain) {
  auto scene = std::make_shared<scene::Scene>(*plain.scene);
  add(*scene, sphere(0.8f, 16, false), medium_boundary({}));
  Mat4 away(1);
  away[3] = Vec4(100, 0, 0, 1);
  add(*scene, sphere(1, 8, false), medium_boundary(medium(Rgb(1))), away);
  render::Document general = plain;
  general.scene = scene;
  return general;
}

Document foggy_cornell_box() {
  Document d = cornell(kSize);
  auto scene = std::make_shared<scene::Scene>(*d.scene);
  scene->atmosphere.medium = medium(Rgb(0.15f), Rgb(0.02f), 0.5f);
  scene->atmosphere.radius = 5;
  d.scene = std::move(scene);
  return d;
}

Document glass_of_milk() {
  scene::Scene scene;
  add(scene, shell(1, 0.9f, 12), liquid(1.5f), at({0, 1, 0}));
  add(scene, sphere(0.94f, 12, false), turbid_liquid(1.34f, medium({4, 5, 6}, {0.01f, 0.02f, 0.1f}, 0.3f)),
      at({0, 1, 0}));
  add(scene, quad(4), diffuse(Rgb(0.6f)), at({0, -0.05f, 0}));
  add_area_light(scene, 1.2f, 5, {0.5f, 3.5f, 0.5f});
  scene.environment.tint = {0.7f, 0.8f, 1.0f};
  return seen_from(std::move(scene), {0, 2.2f, 4}, {0, 0.8f, 0}, 0.65f);
}

Document stone_in_murky_water() {
  scene::Scene scene;
  add(scene, scene::box({1, 0.6f, 1}), turbid_liquid(1.33f, medium({0.3f, 0.6f, 0.4f}, {0.5f, 0.2f, 0.1f}, 0.7f)),
      at({0, 0.6f, 0}));
  add(scene, sphere(0.4f, 16, false), diffuse({0.8f, 0.7f, 0.5f}), at({0.2f, 0.45f, 0.1f}));
  add(scene, quad(4), diffuse(Rgb(0.6f)), at({0, -0.05f, 0}));
  add_area_light(scene, 1.5f, 3, {0, 3, 0});
  scene.environment.tint = {0.7f, 0.8f, 1.0f};
  return seen_from(std::move(scene), {0, 2.2f, 3.2f}, {0, 0.5f, 0}, 0.7f);
}

Document spot_light_in_fog() {
  scene::Scene scene;
  add(scene, scene::box({1.4f, 1, 1.4f}), medium_boundary(medium(Rgb(0.6f), Rgb(0), 0.4f)), at({0, 1, 0}));
  add(scene, sphere(0.4f, 16, false), diffuse({0.8f, 0.5f, 0.4f}), at({0.3f, 0.5f, 0}));
  add(scene, quad(3), diffuse(Rgb(0.5f)), at({0, -0.05f, 0}));
  Light spot = make_light("spot", {{"intensity", 20.0}, {"inner-cone", 0.2}, {"outer-cone", 0.4}});
  Transform aim;
  aim.matrix = look_at({-1.6f, 2.2f, 0.5f}, {0.2f, 0.4f, 0}, {0, 1, 0}, 1).to_world;
  add(scene, spot, aim);
  return seen_from(std::move(scene), {0, 1.5f, 4}, {0, 0.8f, 0}, 0.8f);
}

Document camera_in_fog() {
  scene::Scene scene;
  add(scene, sphere(2, 16, false), medium_boundary(medium({1.2f, 0.5f, 0.2f}, {0, 0.1f, 0.3f}, -0.3f)), at({0, 1, 0}));
  add(scene, sphere(0.4f, 16, false), diffuse({0.8f, 0.5f, 0.4f}), at({0, 0.8f, 0}));
  add(scene, quad(3), diffuse(Rgb(0.5f)));
  add_area_light(scene, 0.8f, 6, {0.3f, 2.2f, 0.3f});
  scene.environment.tint = {0.3f, 0.4f, 0.5f};
  return seen_from(std::move(scene), {0, 1.2f, 1.7f}, {0, 0.8f, 0}, 1);
}

}  // namespace etendue::test
