#include "geometry/mesh.h"

namespace etendue {

Bounds bounds_of(const Mesh& mesh, const Mat4& transform) {
  Bounds bounds;
  for (const Vec3& p : mesh.positions) bounds.extend(Vec3(transform * Vec4(p, 1)));
  return bounds;
}

}  // namespace etendue
