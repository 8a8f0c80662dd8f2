// The range of coordinates that can be rendered in single precision.
#pragma once
#include <cmath>

#include "base/vec.h"

namespace etendue::scene {

// Largest absolute coordinate in metres, of a vertex in its mesh and in the world. The elements of world matrices have
// the same limit.
//
// Shading computes |e1 x e2|^2 for the edges of a triangle. Within this range the components of edges are at most 2e9,
// those of the cross product 8e18, and the square of its length 1.9e38: the largest float is 3.4e38. Embree multiplies
// three coordinates, which overflows beyond about 1e12 m.
inline constexpr float kMaxCoordinate = 1e9f;

// False for NaN as well.
inline bool is_within_range(const Vec3& p) {
  return std::abs(p.x) <= kMaxCoordinate && std::abs(p.y) <= kMaxCoordinate && std::abs(p.z) <= kMaxCoordinate;
}

inline bool is_within_range(const Mat4& m) {
  for (int column = 0; column < 4; ++column)
    if (!is_within_range(Vec3(m[column]))) return false;
  return true;
}

}  // namespace etendue::scene
