// Surfaces of revolution with smooth normals: balls, eggs, and what a potter turns.
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "geometry/mesh.h"

namespace etendue::scene {

// A point of the outline: x is the distance from the axis, y the height, in metres. The normal need not be a unit
// vector.
struct OutlinePoint {
  Vec2 position, normal;
};

// Turns an outline about +y; it runs upwards with the outside on its right. Closed where it begins and ends on the
// axis. Two points in one place with two normals make a crease.
std::shared_ptr<const Mesh> lathe(std::span<const OutlinePoint> outline, int segments);

// Around the origin.
std::shared_ptr<const Mesh> ball(float radius, int rings);
// As wide as a ball of this radius; its halves are half ellipsoids of these heights.
std::shared_ptr<const Mesh> egg(float radius, float below, float above, int rings);

// A smooth outline through these points (Catmull & Rom 1974), `steps` pieces between one and the next.
std::vector<OutlinePoint> smooth_outline(std::span<const Vec2> points, int steps);

}  // namespace etendue::scene
