#include "scene/builtin/integrating_sphere.h"

#include "scene/builtin/lathe.h"
#include "scene/builtin/scene_builder.h"

namespace etendue::scene {
namespace {

constexpr int kRings = 160;  // from pole to pole; there are twice as many segments around

// The part of the sphere between two polar angles from +y, facing inwards, without vertex normals.
std::shared_ptr<const Mesh> zone(double from, double to) {
  constexpr int kMinRings = 12;
  const int rings = std::max(kMinRings, static_cast<int>(std::ceil((to - from) / kPi * kRings)));
  std::vector<OutlinePoint> outline;
  for (int i = 0; i <= rings; ++i) {
    const double angle = from + (to - from) * i / rings;
    const bool pole = (i == 0 && from == 0) || (i == rings && to == kPi);
    const Vec2 p(pole ? 0.0 : std::sin(angle), std::cos(angle));
    outline.push_back({p, -p});
  }
  auto mesh = std::make_shared<Mesh>(*lathe(outline, 2 * kRings));
  mesh->normals.clear();
  mesh->positions.reserve(mesh->positions.size() + 1);
  return mesh;
}

}  // namespace

Scene integrating_sphere(double fraction, float albedo, Cap cap) {
  Scene scene;
  scene.name = "Integrating sphere";
  const double edge = std::acos(1 - 2 * fraction);
  Material emitter = diffuse(Rgb(cap == Cap::black ? 0 : albedo), Rgb(1));
  emitter.double_sided = false;
  add(scene, "cap", zone(0, edge), add_material(scene, "cap", emitter));
  add(scene, "wall", zone(edge, kPi), add_diffuse(scene, "wall", Rgb(albedo)));
  return scene;
}

Camera integrating_sphere_camera() { return look_at(Vec3(0), {0, -1, 0}, {0, 0, 1}, 1); }

}  // namespace etendue::scene
