// Simple shapes and the shortest way to put them into a scene: what scenes with answers in closed form are made of.
#pragma once
#include <memory>

#include "scene/scene.h"

namespace etendue::scene {

// A Lambertian material without a specular layer, seen from both sides.
Material diffuse(const Rgb& albedo, const Rgb& emission = Rgb(0));

// Clear, smooth, solid glass.
Material glass(float ior = 1.5f);

// Meshes around the origin, in metres.
std::shared_ptr<const Mesh> cube(float half_size, bool inwards);
std::shared_ptr<const Mesh> box(const Vec3& half_size, bool inwards = false);
std::shared_ptr<const Mesh> quad(float half_size);             // in the xz plane, facing +y
std::shared_ptr<const Mesh> disk(float radius, int segments);  // in the xz plane, facing +y, of the disk's area
std::shared_ptr<const Mesh> sphere(float radius, int rings, bool inwards);
// From one corner along two sides, facing their cross product.
std::shared_ptr<const Mesh> rectangle(const Vec3& corner, const Vec3& u, const Vec3& v);

// Puts a mesh with a material of its own into the scene; returns the node.
int add(Scene& scene, std::shared_ptr<const Mesh> mesh, const Material& material, const Mat4& transform = Mat4(1));

// Puts a light into the scene; returns the node.
int add(Scene& scene, const Light& light, const Transform& transform);
int add_point_light(Scene& scene, const Vec3& position, float intensity);

// A closed cube of one diffuse material that emits radiance one: L = 1 / (1 - albedo) everywhere.
Scene furnace(float albedo);

}  // namespace etendue::scene
