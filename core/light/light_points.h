// A surface light as so many points.                                            thesis 4.3, digest item 81, erratum E31
//
// Each stands for an equal share A / N of the area and shines as that does: E = sum of (A / N) L cos cos / r^2. They
// lie on spirals by the golden angle, so that any number of them is spread evenly: on a disk one on each of N rings of
// equal area, on a sphere one on each of N zones, on a quad one on each of N strips.
#pragma once
#include <vector>

#include "light/light_table.h"

namespace etendue {

// Of a surface with `points`, on both sides if it has two; `node` is where it is placed, `motion` how that moves.
std::vector<PlacedLight> points_of(const Light& light, const Mat4& node, const std::shared_ptr<const Motion>& motion);

}  // namespace etendue
