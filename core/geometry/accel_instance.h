// What an acceleration structure consists of.
#pragma once
#include <cstdint>
#include <memory>

#include "geometry/analytic_shape.h"
#include "geometry/motion.h"

namespace etendue {

class MeshAccel;

// An instance of a mesh, a mesh in world space, or an analytic shape.
struct AccelInstance {
  std::shared_ptr<const Mesh> mesh;
  std::shared_ptr<const MeshAccel> accel;                // null: the mesh is part of the top level and in world space
  Mat4 to_world{1};                                      // of a mesh with `accel`
  std::shared_ptr<const Motion> motion = nullptr;        // null: static. Deforming meshes have no `accel`
  std::shared_ptr<const AnalyticShape> shape = nullptr;  // instead of a mesh; in world space if static
};

// Another place for an instance of a mesh without motion.
struct MovedInstance {
  uint32_t number = 0;  // of the instance
  std::shared_ptr<const MeshAccel> accel;
  Mat4 to_world{1};
};

}  // namespace etendue
