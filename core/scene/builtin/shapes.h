// Simple shapes, and functions that add them to a scene. Test scenes with closed-form solutions consist of them.
#pragma once
#include <memory>

#include "scene/scene.h"

namespace etendue::scene {

// A Lambertian material without a specular layer, double-sided.
Material diffuse(const Rgb& albedo, const Rgb& emission = Rgb(0));

// Smooth solid glass without absorption.
Material glass(float ior = 1.5f);

// The mesh with the padding that Embree needs (see Mesh::positions).
std::shared_ptr<const Mesh> padded(Mesh mesh);

// Meshes around the origin, in metres.
std::shared_ptr<const Mesh> cube(float half_size, bool inwards);
std::shared_ptr<const Mesh> box(const Vec3& half_size, bool inwards = false);
std::shared_ptr<const Mesh> quad(float half_size);  // in the xz plane, facing +y
std::shared_ptr<const Mesh> disk(float radius,
                                 int segments);  // in the xz plane, facing +y; a polygon with the area of the disk
std::shared_ptr<const Mesh> sphere(float radius, int rings, bool inwards);
// A parallelogram with one corner and two sides; it faces u x v.
std::shared_ptr<const Mesh> rectangle(const Vec3& corner, const Vec3& u, const Vec3& v);

// Adds a mesh and its material to the scene; returns the index of the node.
int add(Scene& scene, std::shared_ptr<const Mesh> mesh, const Material& material, const Mat4& transform = Mat4(1));

// Adds a light to the scene; returns the index of the node.
int add(Scene& scene, const Light& light, const Transform& transform);
int add_point_light(Scene& scene, const Vec3& position, float intensity);

// A closed cube of one diffuse material that emits radiance 1. The solution is L = 1 / (1 - albedo) everywhere.
Scene furnace(float albedo);

}  // namespace etendue::scene
