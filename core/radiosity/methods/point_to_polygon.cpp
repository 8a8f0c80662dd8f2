// Points to polygon                                                   [Lambert 1760; Lang, sec. 10.1.4, eq. 10.98, corrected]
//
//    F_ij  ~  1 / N  sum over points x of element i of  V(x, y) F_xj
//
// F_xj is the closed form for a point and an unoccluded polygon, y is a uniform point of element j. Without occlusion,
// only the position of x is random.
#include "radiosity/element_pairs.h"

namespace etendue::radiosity {
namespace {

uint64_t add_row_by_points(const RowRequest& request) {
  const PatchMesh& mesh = request.mesh;
  const DVec3 normal(mesh.normal_of(request.element));
  VisibilityRays rays(request.scene, element_seed(request.seed, request.element));
  for_each_facing(mesh, request.element, [&](uint32_t other) {
    const Polygon polygon = polygon_of(mesh, other);
    const auto factor = [&](const Vec3& from, const Vec3&) { return point_to_polygon(DVec3(from), normal, polygon); };
    const double sum = sum_over_pairs(request, other, rays, factor).sum;
    if (sum > 0) request.row.add(other, sum / request.samples);
  });
  return rays.traced();
}

}  // namespace

FormFactorMethodInfo point_to_polygon_method() {
  return {.doc =
              "Closed form from points of a patch to the other patch, times the visibility of one ray. Less noisy than "
              "area sampling, also at common edges",
          .samples_pairs = true,
          .add_row = add_row_by_points};
}

}  // namespace etendue::radiosity
