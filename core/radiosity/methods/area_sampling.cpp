// Area-to-area Monte Carlo                                                              [Lang, sec. 10.1.4, eq. 10.90]
//
//    F_ij  ~  A_j / N  sum of  V cos cos / (pi r^2)
//
// over pairs of uniform points of both elements. The variance is small for distant elements and infinite for elements
// with a common edge.
#include "radiosity/element_pairs.h"

namespace etendue::radiosity {
namespace {

uint64_t add_row_by_area(const RowRequest& request) {
  const PatchMesh& mesh = request.mesh;
  const DVec3 normal(mesh.normal_of(request.element));
  VisibilityRays rays(request.scene, element_seed(request.seed, request.element));
  for_each_facing(mesh, request.element, [&](uint32_t other) {
    const DVec3 facing(mesh.normal_of(other));
    const auto kernel = [&](const Vec3& from, const Vec3& to) {
      const DVec3 d = DVec3(to) - DVec3(from);
      const double r2 = glm::dot(d, d), cosine = glm::dot(d, normal), other_cosine = -glm::dot(d, facing);
      return cosine > 0 && other_cosine > 0 ? cosine * other_cosine / (static_cast<double>(kPi) * r2 * r2) : 0;
    };
    const double sum = sum_over_pairs(request, other, rays, kernel).sum;
    if (sum > 0) request.row.add(other, static_cast<double>(mesh.patch_of(other).area) * sum / request.samples);
  });
  return rays.traced();
}

}  // namespace

FormFactorMethodInfo area_sampling_method() {
  return {.doc = "Pairs of points of two patches. Accurate for distant patches; infinite variance at common edges",
          .samples_pairs = true,
          .add_row = add_row_by_area};
}

}  // namespace etendue::radiosity
