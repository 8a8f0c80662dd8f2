// Functions that add named materials and objects to a scene.
#pragma once
#include <memory>

#include "scene/builtin/shapes.h"
#include "scene/scene.h"

namespace etendue::scene {

// Add a material; each returns its index.
int add_material(Scene& scene, const char* name, Material material);
int add_diffuse(Scene& scene, const char* name, const Rgb& albedo);
// Black, emits this radiance from its front side.
int add_emitter(Scene& scene, const char* name, const Rgb& radiance);
int add_metal(Scene& scene, const char* name, const Rgb& color, float roughness);
int add_glass(Scene& scene, const char* name, float ior);

// Add an object; each returns its node.
Node& add(Scene& scene, const char* name, std::shared_ptr<const Mesh> mesh, int material,
          const Transform& transform = {});
Node& add(Scene& scene, const char* name, const Light& light, const Mat4& to_world);
void add(Scene& scene, Camera camera);

// An axis-aligned box between two corners.
Node& add_box(Scene& scene, const char* name, int material, const Vec3& lower, const Vec3& upper);
// The materials of the six inner sides of a room: floor, ceiling, and the walls at -z, +z, -x and +x.
struct RoomMaterials {
  int floor, ceiling, back, front, left, right;
};
void add_room(Scene& scene, const Vec3& lower, const Vec3& upper, const RoomMaterials& materials);

inline Transform translated(const Vec3& translation) { return {.translation = translation}; }
// Rotated about the x or y axis by an angle in radians, then translated.
Transform rotated_x(const Vec3& translation, float angle);
Transform rotated_y(const Vec3& translation, float angle);

}  // namespace etendue::scene
