// Position and direction of a light without extent.
#pragma once
#include "base/frame.h"

namespace etendue {

struct LightPlace {
  Vec3 position{0}, direction{0, 0, -1};  // m; unit
  Vec3 tangent{1, 0, 0};                  // the node's x axis; any length

  LightPlace() = default;
  // At the origin of a node, along its -z axis. The node's scale has no effect.
  explicit LightPlace(const Mat4& node)
      : position(node[3]), direction(normalize_or(-Vec3(node[2]), Vec3(0, 0, -1))), tangent(node[0]) {}

  // x along the node's x axis, z against the direction of emission.
  Frame frame() const { return {-direction, tangent, 1}; }
};

}  // namespace etendue
