// Surfaces of revolution with vertex normals.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "geometry/mesh.h"

namespace etendue::scene {

// A point of the profile curve: x is the distance from the axis, y the height, in metres. The normal may have any
// length.
struct OutlinePoint {
  Vec2 position, normal;
};

// Rotates a profile curve about the y axis. The curve runs upwards with the outside on its right. The surface is closed
// if the curve starts and ends on the axis. Two points at the same position with different normals make a crease.
std::shared_ptr<const Mesh> lathe(std::span<const OutlinePoint> outline, int segments);

// A sphere around the origin.
std::shared_ptr<const Mesh> ball(float radius, int rings);
// Two half ellipsoids with a common radius; `below` and `above` are their heights.
std::shared_ptr<const Mesh> egg(float radius, float below, float above, int rings);

// A smooth profile curve through the points [Catmull and Rom 1974], with `steps` segments between neighbours.
std::vector<OutlinePoint> smooth_outline(std::span<const Vec2> points, int steps);

}  // namespace etendue::scene
