// Area-to-area Monte Carlo                                                              [Lang, sec. 10.1.4, eq. 10.90]
//
//    F_ij  ~  A_j / N  sum of  V cos cos / (pi r^2)
//
// over pairs of uniform points of both elements. The variance is small for distant elements and infinite for elements
// with a common edge.
#include "base/warp.h"
#include "radiosity/element_pairs.h"

namespace etendue::radiosity {
namespace {

uint64_t add_row_by_area(const RowRequest& request) {
  const PatchMesh& mesh = request.mesh;
  const Patch& patch = mesh.patch_of(request.element);
  const Vec3 normal = mesh.normal_of(request.element);
  VisibilityRays rays(request.scene, element_seed(request.seed, request.element));
  for_each_facing(mesh, request.element, [&](uint32_t other) {
    const Patch& target = mesh.patch_of(other);
    const Vec3 facing = mesh.normal_of(other);
    double sum = 0;
    const auto add = [&](double kernel) { sum += kernel; };
    for (uint32_t s = 0; s < request.samples; ++s) {
      SampleBlock u;
      request.sampler.block(pair_seed(request, other), s, 0, u);
      const Vec3 from = patch.point(square_to_triangle({u[0], u[1]})),
                 to = target.point(square_to_triangle({u[2], u[3]}));
      const glm::dvec3 d = glm::dvec3(to) - glm::dvec3(from);
      const double r2 = glm::dot(d, d);
      const double cosines = glm::dot(d, glm::dvec3(normal)) * -glm::dot(d, glm::dvec3(facing));
      if (!(cosines > 0) || glm::dot(d, glm::dvec3(normal)) <= 0) continue;
      rays.add(off_surface(mesh, request.element, from), off_surface(mesh, other, to),
               cosines / (static_cast<double>(kPi) * r2 * r2), add);
    }
    rays.trace(add);
    if (sum > 0) request.row.add(other, static_cast<double>(target.area) * sum / request.samples);
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
