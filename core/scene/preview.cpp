#include "scene/preview.h"

#include <cmath>

#include "light/environments/studio.h"
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

Environment environment_of(const Scene& from, PreviewLight light) {
  Environment environment;
  switch (light) {
    case PreviewLight::studio:
      environment = make_environment(kStudio);
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
