// How the built-in scenes are put together: materials that things share, and things by name.
#pragma once
#include <memory>

#include "scene/builtin/shapes.h"
#include "scene/scene.h"

namespace etendue::scene {

// Materials; each returns its number.
int add_material(Scene& scene, const char* name, Material material);
int add_paint(Scene& scene, const char* name, const Rgb& albedo);
// Reflects nothing and shines from its front, with this radiance.
int add_lamp(Scene& scene, const char* name, const Rgb& radiance);
int add_metal(Scene& scene, const char* name, const Rgb& color, float roughness);
int add_glass(Scene& scene, const char* name, float ior);

// Things.
Node& add(Scene& scene, const char* name, std::shared_ptr<const Mesh> mesh, int material, const Transform& place = {});
Node& add(Scene& scene, const char* name, const Light& light, const Mat4& place);
void add(Scene& scene, Camera camera);

// A box from one corner to the other.
Node& add_box(Scene& scene, const char* name, int material, const Vec3& least, const Vec3& most);
// The six sides of a room, seen from within: floor, ceiling, and the walls towards -z, +z, -x and +x.
struct Paints {
  int floor, ceiling, back, front, left, right;
};
void add_room(Scene& scene, const Vec3& least, const Vec3& most, const Paints& paints);

inline Transform moved(const Vec3& to) { return {.translation = to}; }
// Turned about the x or y axis, by radians.
Transform tipped(const Vec3& to, float angle);
Transform turned(const Vec3& to, float angle);

}  // namespace etendue::scene
