#include "support/integrator_scenes.h"

#include <gtest/gtest.h>

#include "light/environments/sky.h"

namespace etendue::test {

using render::Document;

Document with(const Document& d, const char* name, const std::string& value) {
  const auto changed = render::with_text(d, name, value);
  EXPECT_TRUE(changed) << name << " = " << value;
  return changed ? *changed : d;
}

Document with_integrator(const Document& d, const std::string& integrator) {
  return with(d, "render.integrator", integrator);
}

Document without_specular_first_hit(const Document& d) { return with(d, "film.paths", "E[(D|G).*]L"); }

scene::Scene balls() {
  scene::Scene scene;
  add(scene, quad(4), diffuse(Rgb(0.6f)));
  Material glass, clay;
  glass.metallic = 0;
  glass.transmission = 1;
  glass.thickness = 1;
  glass.roughness = 0;
  glass.attenuation_color = {0.4f, 0.8f, 0.9f};
  glass.attenuation_distance = 0.7f;
  clay.base_color = {0.7f, 0.3f, 0.2f};
  clay.metallic = 0;
  clay.roughness = 0.3f;
  const std::pair<Material, bool> materials[] = {{diffuse(Rgb(0.5f)), true}, {glass, false}, {clay, true}};
  for (int i = 0; i < 3; ++i) {
    Mat4 place(1);
    place[3] = Vec4(-1.2f + 1.2f * static_cast<float>(i), 0.6f, 0, 1);
    auto ball = std::make_shared<Mesh>(*sphere(0.55f, 8, false));
    if (materials[i].second)
      for (const Vec3& p : ball->positions) ball->normals.push_back(glm::normalize(p));
    add(scene, ball, materials[i].first, place);
  }
  return scene;
}

Document view_from_above(scene::Scene scene) {
  return document(std::move(scene), look_at({0, 2, 4}, {0, 0.4f, 0}, {0, 1, 0}, 0.7f), kSize, kSize);
}

Document balls_under_area_light() {
  auto scene = balls();
  Material light = diffuse(Rgb(0.3f), Rgb(6));
  Mat4 above(1);
  above[1][1] = -1;
  above[2][2] = -1;
  above[3] = Vec4(0, 3, 1, 1);
  add(scene, quad(1), light, above);
  return view_from_above(std::move(scene));
}

Document balls_under_sky() {
  auto scene = balls();
  scene.environment.tint = {0.7f, 0.8f, 1.0f};
  return view_from_above(std::move(scene));
}

Document balls_under_sun() {
  auto scene = balls();
  Sky sky;
  sky.sun_elevation = 0.8f;
  scene.environment = make_sky(sky);
  scene.environment.tint = Rgb(1e-4f);
  return view_from_above(std::move(scene));
}

Document balls_under_light(const char* light_type) {
  auto scene = balls();
  Light light = make_light(light_type);
  light.set("intensity", light.info().description.light_class == LightClass::delta_direction ? 3.0 : 12.0);
  light.set("inner-cone", 0.3);
  light.set("outer-cone", 0.6);
  if (!light.parameter("outer-cone")) light.set("range", 5.0);
  scene::Transform place;
  place.matrix = look_at({0.8f, 3, 1}, {0, 0, 0}, {0, 1, 0}, 1).to_world;
  add(scene, light, place);
  return view_from_above(std::move(scene));
}

Document balls_under_analytic_lights() {
  auto scene = balls();
  const auto add_light = [&](Light light, const Rgb& color, const Vec3& from, const Vec3& to) {
    light.color = color;
    light.set("intensity", 9.0);
    scene::Transform place;
    place.matrix = look_at(from, to, {0, 0.99f, 0.1f}, 1).to_world;
    add(scene, light, place);
  };
  add_light(make_light("quad", {{"width", 0.9}, {"height", 0.6}, {"focus", 2.0}}), {1, 0.6f, 0.4f}, {-1.5f, 2.2f, 1},
            {-0.5f, 0, 0});
  add_light(make_light("disk", {{"two-sided", true}}), {0.5f, 1, 0.6f}, {0.3f, 2.5f, -0.8f}, {0.2f, 0, 0.1f});
  add_light(make_light("sphere"), {0.5f, 0.7f, 1}, {1.7f, 1.6f, 0.9f}, {0, 0, 0});
  add_light(make_light("cylinder", {{"radius", 0.1}, {"length", 1.2}}), {1, 0.8f, 0.5f}, {-0.2f, 1.9f, 1.2f},
            {0, 0, 0});
  return view_from_above(std::move(scene));
}

Document room_with_two_windows(bool portal) {
  scene::Scene scene;
  const auto add_wall = [&](const Vec3& corner, const Vec3& u, const Vec3& v) {
    add(scene, scene::rectangle(corner, u, v), diffuse(Rgb(0.6f)));
  };
  add_wall({-1, 0, -1}, {0, 0, 2}, {2, 0, 0});
  add_wall({-1, 0, -1}, {2, 0, 0}, {0, 2, 0});
  add_wall({-1, 0, 1}, {0, 2, 0}, {2, 0, 0});
  add_wall({1, 0, -1}, {0, 0, 2}, {0, 2, 0});
  for (const float z : {-1.0f, 0.1f}) add_wall({-1, 0, z}, {0, 2, 0}, {0, 0, 0.9f});
  for (const float x : {-1.0f, 0.25f}) add_wall({x, 2, -1}, {0.75f, 0, 0}, {0, 0, 2});
  for (const float z : {-1.0f, 0.25f}) add_wall({-0.25f, 2, z}, {0.5f, 0, 0}, {0, 0, 0.75f});
  scene.environment.tint = {6, 7, 8};
  if (portal) {
    scene::Node node;
    node.transform.matrix = Mat4({1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, 2, 0, 1});
    node.portal = {0.5f, 0.5f};
    scene.roots.push_back(static_cast<int>(scene.nodes.size()));
    scene.nodes.push_back(node);
  }
  return document(std::move(scene), look_at({0.6f, 1.2f, 0.8f}, {-0.2f, 0.4f, -0.5f}, {0, 1, 0}, 1), kSize, kSize);
}

Document with_lens(const Document& d) {
  return with(with(d, "camera.lens-radius", "0.25"), "camera.focus-distance", "4");
}

void expect_same_mean(const Document& a, uint32_t samples_a, const Document& b, uint32_t samples_b,
                      const std::string& what, int comparisons) {
  expect_agreement(replicated(a, samples_a), replicated(b, samples_b), what, comparisons);
}

namespace {

Material modelled(const char* model, std::initializer_list<std::pair<const char*, Value>> settings) {
  Material m;
  m.base_color = {0.7f, 0.5f, 0.4f};
  m.model.model = make_bsdf_model(model);
  for (const auto& [name, value] : settings) m.model.model = m.model->with(name, value);
  return m;
}

}  // namespace

// The floor, a row of balls with one reflection model each, and a quad light.
Document bsdf_model_scene() {
  scene::Scene scene;
  // The lobe of the floor is not reciprocal: radiance and importance scatter differently.
  add(scene, scene::quad(4), modelled("phong", {{"diffuse", 0.4}, {"exponent", 6.0}}));
  Material coated;
  coated.metallic = 0;
  coated.base_color = {0.6f, 0.2f, 0.2f};
  coated.roughness = 0.6f;
  coated.clearcoat = 0.8f;
  coated.clearcoat_roughness = 0.35f;
  coated.sheen_color = Rgb(0.3f);
  coated.sheen_roughness = 0.5f;
  const Material materials[] = {
      modelled("ward", {{"alpha-x", 0.2}, {"alpha-y", 0.5}}),
      modelled("torrance-sparrow", {{"alpha-x", 0.5}, {"alpha-y", 0.5}}),
      modelled("dielectric", {{"roughness", 0.3}}),
      modelled("tabulated", {{"polar-steps", int64_t{12}}, {"azimuth-steps", int64_t{48}}}),
      coated,
  };
  for (int i = 0; i < 5; ++i) {
    Mat4 place(1);
    place[3] = Vec4(-2.2f + 1.1f * static_cast<float>(i), 0.55f, 0, 1);
    add(scene, scene::sphere(0.5f, 16, false), materials[i], place);
  }
  Mat4 above(1);
  above[1][1] = -1;
  above[2][2] = -1;
  above[3] = Vec4(0, 3, 1, 1);
  add(scene, scene::quad(1), scene::diffuse(Rgb(0), Rgb(6)), above);
  scene.environment.tint = {0.2f, 0.25f, 0.3f};
  return document(scene, look_at({0, 2, 5}, {0, 0.4f, 0}, {0, 1, 0}, 0.8f), kSize, kSize);
}

}  // namespace etendue::test
