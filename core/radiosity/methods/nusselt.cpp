// Nusselt's analogue                                                              [Nusselt 1928; Lang, sec. 10.1.4, eq. 10.94]
//
// The factor from a point to an element is the share of the unit disk that the element covers after a projection to the
// hemisphere and from there to its base. The disk is divided into m x m cells of equal area (Shirley and Chiu's map of a
// square), so that every cell has the factor 1 / m^2, and a ray through its centre finds the element that covers it.
// Deterministic; rows sum to 1 in closed scenes. The error of the shares falls with the width 1 / m of the cells. Small
// or distant elements between the rays are missed, and the centroid stands for the whole element.
#include <algorithm>
#include <cmath>

#include "base/frame.h"
#include "base/warp.h"
#include "radiosity/form_factors.h"
#include "radiosity/patch_rays.h"

namespace etendue::radiosity {
namespace {

uint64_t add_row_by_nusselt(const RowRequest& request) {
  const PatchMesh& mesh = request.mesh;
  const Patch& patch = mesh.patch_of(request.element);
  const Frame frame(mesh.normal_of(request.element), patch.p1 - patch.p0, 1);
  const Vec3 origin = off_surface(mesh, request.element, patch.point(Vec2(1.0f / 3)));
  const int m = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(request.samples)) + 0.5));
  const double factor = 1.0 / (static_cast<double>(m) * m);
  HitRays rays(request.scene, mesh, element_seed(request.seed, request.element));
  const auto count = [&](uint32_t element, float) {
    if (element != request.element) request.row.add(element, factor);
  };
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < m; ++j) {
      const Vec2 cell((static_cast<float>(i) + 0.5f) / static_cast<float>(m),
                      (static_cast<float>(j) + 0.5f) / static_cast<float>(m));
      rays.add(origin, frame.to_world(square_to_cosine_hemisphere(cell)), 1, count);
    }
  rays.trace(count);
  return rays.traced();
}

}  // namespace

FormFactorMethodInfo nusselt_method() {
  return {.doc =
              "Rays from the centroid through cells of equal area of the projected hemisphere. Deterministic; rows sum "
              "to 1 in closed scenes; misses what lies between the rays, and is wrong for close patches",
          .samples_pairs = false,
          .add_row = add_row_by_nusselt};
}

}  // namespace etendue::radiosity
