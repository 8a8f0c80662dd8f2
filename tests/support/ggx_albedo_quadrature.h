// The directional albedo of GGX microfacets by quadrature, and the table of core/bsdf/microfacet/ggx_albedo_table.h.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "bsdf/microfacet/ggx_albedo.h"

namespace etendue::test {

// The albedo by the midpoint rule over 96 x 64 visible normals, with an absolute error of at most 1e-4. `cosine` is
// that of wo to the normal, in (0, 1]; alpha is in (0, 1].
GgxAlbedo ggx_albedo_by_quadrature(double cosine, double alpha);

// The table of ggx_albedo_table.h: values at the nodes, raised until the interpolation exceeds the albedo at 5 x 5
// points of every cell.
using GgxAlbedoTable = std::array<std::array<GgxAlbedo, kGgxAlbedoCosines>, kGgxAlbedoRoughnesses>;
GgxAlbedoTable computed_ggx_albedo_table();

}  // namespace etendue::test
