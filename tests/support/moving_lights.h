// A triangle and a point light with the same motion.
#pragma once
#include "light/placed_light.h"
#include "light/sampling/light_table.h"

namespace etendue::test {

struct MovingLights {
  std::shared_ptr<Mesh> mesh = std::make_shared<Mesh>();
  std::shared_ptr<Motion> motion = std::make_shared<Motion>();
  AreaLightTriangle triangle;
  PlacedLight point;

  // Moves from the identity to `end`.
  explicit MovingLights(const Mat4& end) {
    mesh->positions.reserve(4);
    mesh->positions = {{0, 3, 0}, {1, 3, 0}, {0, 3, 1}};
    mesh->triangles = {{0, 1, 2}};
    motion->to_world = {Mat4(1), end};
    triangle.radiance = Rgb(1);
    triangle.moving = true;
    triangle.set_triangle(motion->facet_at(*mesh, mesh->triangles[0], 0.5f));
    point.motion = motion;
    point.place = LightPlace(motion->matrix_at(0.5f));
  }

  LightTable table(const Bounds& bounds) const {
    return {{triangle}, {point}, std::make_shared<const EnvironmentMap>(), bounds, {{mesh, motion}}};
  }
};

}  // namespace etendue::test
