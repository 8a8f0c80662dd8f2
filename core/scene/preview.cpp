#include "scene/preview.h"

#include <cmath>

#include "scene/builtin/scene_builder.h"
#include "scene/builtin/shapes.h"

namespace etendue::scene {
namespace {

constexpr int kRings = 48, kSegments = 96;

// A unit sphere. Tangents point east; texture coordinates repeat four times around and twice from pole to pole.
std::shared_ptr<const Mesh> sphere_with_tangents() {
  auto mesh = std::make_shared<Mesh>();
  for (int r = 0; r <= kRings; ++r)
    for (int s = 0; s <= kSegments; ++s) {
      const float v = static_cast<float>(r) / kRings, u = static_cast<float>(s) / kSegments;
      const float theta = kPi * v, phi = 2 * kPi * u;
      const Vec3 n(std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi));
      mesh->positions.push_back(n);
      mesh->normals.push_back(n);
      mesh->tangents.emplace_back(std::cos(phi), 0, -std::sin(phi), 1);
      mesh->uvs[0].emplace_back(4 * u, 2 * v);
    }
  const auto at = [](int r, int s) { return static_cast<uint32_t>(r * (kSegments + 1) + s); };
  for (int r = 0; r < kRings; ++r)
    for (int s = 0; s < kSegments; ++s) {
      if (r > 0) mesh->triangles.push_back({at(r, s), at(r + 1, s), at(r, s + 1)});
      if (r + 1 < kRings) mesh->triangles.push_back({at(r, s + 1), at(r + 1, s), at(r + 1, s + 1)});
    }
  mesh->uvs[1] = mesh->uvs[0];
  mesh->positions.reserve(mesh->positions.size() + 1);
  return mesh;
}

// A rectangular light in the environment map with soft edges; 1 inside, 0 outside.
float soft_box(float u, float v, float u0, float v0, float width, float height) {
  const auto inside = [](float x, float half) { return std::clamp((half - std::abs(x)) / (0.15f * half), 0.0f, 1.0f); };
  const float du = u - u0 - std::floor(u - u0 + 0.5f);
  return inside(du, 0.5f * width) * inside(v - v0, 0.5f * height);
}

// A grey environment with a large soft box on the left, a narrow one on the right and one behind.
std::shared_ptr<const image::Image> studio() {
  constexpr int kWidth = 256, kHeight = 128;
  auto map = std::make_shared<image::Image>();
  map->width = kWidth;
  map->height = kHeight;
  map->channels = 3;
  map->type = image::PixelType::float32;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const float u = (static_cast<float>(x) + 0.5f) / kWidth, v = (static_cast<float>(y) + 0.5f) / kHeight;
      const float wall = v < 0.5f ? 0.28f + 0.1f * (0.5f - v) : 0.16f - 0.12f * (v - 0.5f);
      const Rgb light = Rgb(wall) + Rgb(6.5f, 6.2f, 5.8f) * soft_box(u, v, 0.62f, 0.32f, 0.12f, 0.26f) +
                        Rgb(4, 4.4f, 5) * soft_box(u, v, 0.88f, 0.38f, 0.035f, 0.34f) +
                        Rgb(3) * soft_box(u, v, 0.2f, 0.25f, 0.2f, 0.12f);
      map->floats.insert(map->floats.end(), {light.r, light.g, light.b});
    }
  return map;
}

Environment environment_of(const Scene& from, PreviewLight light) {
  static const auto kStudio = studio();
  Environment environment;
  switch (light) {
    case PreviewLight::studio:
      environment.map = kStudio;
      environment.tint = Rgb(1);
      break;
    case PreviewLight::furnace:
      environment.tint = Rgb(1);
      break;
    case PreviewLight::area_light:
      environment.tint = Rgb(0.03f);
      break;
    case PreviewLight::scene:
      environment = from.environment;
      environment.visible = true;
      break;
  }
  return environment;
}

}  // namespace

Scene preview_scene(const Scene& from, const Material& material, PreviewLight light) {
  static const auto kSphere = sphere_with_tangents();
  Scene scene;
  scene.name = "Preview";
  scene.textures = from.textures;
  scene.environment = environment_of(from, light);
  add(scene, "sphere", kSphere, add_material(scene, "material", material));
  if (light == PreviewLight::area_light) {
    Material emitter = diffuse(Rgb(0), Rgb(180));
    emitter.double_sided = false;
    add(scene, "light", sphere(0.25f, 16, false), add_material(scene, "light", emitter), translated({-2.4f, 3, 3}));
  }
  return scene;
}

Camera preview_camera() {
  Camera camera = look_at({0, 0.9f, 5}, {0, 0, 0}, {0, 1, 0}, 0.46f);
  camera.name = "preview";
  return camera;
}

}  // namespace etendue::scene
