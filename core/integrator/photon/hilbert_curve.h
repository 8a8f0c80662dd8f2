// The order of points along a Hilbert curve through a cube. Points that are neighbours in this order are close to each
// other, and consecutive groups of them have compact bounding boxes.                                     [Skilling 2004]
#pragma once
#include "base/vectorize.h"

namespace etendue::photon {

// Bits of a cell number along one axis, and of a position along the curve.
inline constexpr int kHilbertAxisBits = 16, kHilbertBits = 3 * kHilbertAxisBits;

struct Cube {
  Vec3 corner{0};  // the minimum
  float size = 1;
};

// Positions along the curve; points outside of the cube count as those on its faces. Arrays are padded to whole
// registers.
void find_hilbert_positions(const Cube& cube, const Vec3LanesView& points, size_t count, uint64_t* positions);

}  // namespace etendue::photon
