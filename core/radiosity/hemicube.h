// The cells of a hemicube: half a cube of edge 2 around a point, with its top in the direction of +z.
//                                                                            [Cohen and Greenberg 1985; Lang, sec. 10.1.4]
#pragma once
#include <vector>

#include "base/vec.h"

namespace etendue::radiosity {

struct HemicubeCell {
  Vec3 direction;  // of the centre, unit
  double factor;   // form factor of the cell from the centre of the base: area cos cos / (pi r^2) at its centre
};

// `resolution` is the even number of cells along an edge of the top; there are 3 resolution^2 cells. Their factors sum to
// 1 with an error of 0.54 / resolution^2.
std::vector<HemicubeCell> hemicube_cells(int resolution);

}  // namespace etendue::radiosity
