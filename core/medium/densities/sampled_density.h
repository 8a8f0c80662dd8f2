// Samples a function at the nodes of a grid.
#pragma once
#include "medium/density_grid.h"

namespace etendue {

// The point of a node; coordinates from -1 to 1.
inline Vec3 node_position(const GridSize& nodes, int x, int y, int z) {
  return 2.0f * Vec3(x, y, z) / Vec3(nodes[0] - 1, nodes[1] - 1, nodes[2] - 1) - Vec3(1);
}

// Calls set(point, index) for all nodes.
template <class Set>
void for_each_node(const GridSize& nodes, Set&& set) {
  size_t index = 0;
  for (int z = 0; z < nodes[2]; ++z)
    for (int y = 0; y < nodes[1]; ++y)
      for (int x = 0; x < nodes[0]; ++x) set(node_position(nodes, x, y, z), index++);
}

inline size_t node_count(const GridSize& nodes) {
  return static_cast<size_t>(nodes[0]) * static_cast<size_t>(nodes[1]) * static_cast<size_t>(nodes[2]);
}

// The density is density(point).
template <class Density>
GridValues sampled_density(const GridSize& nodes, Density&& density) {
  GridValues values{nodes, std::vector<float>(node_count(nodes)), {}};
  for_each_node(nodes, [&](const Vec3& p, size_t i) { values.density[i] = static_cast<float>(density(p)); });
  return values;
}

}  // namespace etendue
