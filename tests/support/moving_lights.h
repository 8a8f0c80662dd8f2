// A triangle and a lamp that go along with one motion.
#pragma once
#include "light/light_table.h"

namespace etendue::test {

struct MovingLights {
  std::shared_ptr<Mesh> mesh = std::make_shared<Mesh>();
  std::shared_ptr<Motion> motion = std::make_shared<Motion>();
  AreaLightTriangle triangle;
  PlacedLight lamp;

  // From where the file has them to `end`.
  explicit MovingLights(const Mat4& end) {
    mesh->positions.reserve(4);
    mesh->positions = {{0, 3, 0}, {1, 3, 0}, {0, 3, 1}};
    mesh->triangles = {{0, 1, 2}};
    motion->to_world = {Mat4(1), end};
    triangle.radiance = Rgb(1), triangle.moving = true;
    triangle.place(motion->facet_at(*mesh, mesh->triangles[0], 0.5f));
    lamp.motion = motion;
    lamp.place = LightPlace(motion->matrix_at(0.5f));
  }

  LightTable table(const Bounds& bounds) const { return {{triangle}, {lamp}, Environment{}, bounds, {{mesh, motion}}}; }
};

}  // namespace etendue::test
