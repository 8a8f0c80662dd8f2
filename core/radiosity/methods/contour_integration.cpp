// Contour integration                                                       [Lang, sec. 10.1.4, eq. 10.97; Goral et al. 1984]
//
// The factor of the two unoccluded patches by Stokes' theorem (closed_forms.h), times the fraction of segments between
// random points of both that are not occluded. Exact without occlusion; approximate where a pair is partly occluded.
#include "radiosity/element_pairs.h"

namespace etendue::radiosity {
namespace {

uint64_t add_row_by_contours(const RowRequest& request) {
  const PatchMesh& mesh = request.mesh;
  const Patch& patch = mesh.patch_of(request.element);
  const DVec3 normal(mesh.normal_of(request.element));
  const Polygon own = polygon_of(mesh, request.element);
  VisibilityRays rays(request.scene, element_seed(request.seed, request.element));
  for_each_facing(mesh, request.element, [&](uint32_t other) {
    const Patch& target = mesh.patch_of(other);
    const DVec3 facing(mesh.normal_of(other));
    const Polygon seen = clipped(polygon_of(mesh, other), DVec3(patch.p0), normal);
    const Polygon seeing = clipped(own, DVec3(target.p0), facing);
    if (seen.empty() || seeing.empty()) return;
    const auto faces = [&](const Vec3& from, const Vec3& to) {
      const DVec3 d(to - from);
      return glm::dot(d, normal) > 0 && glm::dot(d, facing) < 0 ? 1.0 : 0.0;
    };
    const VisiblePairs pairs = sum_over_pairs(request, other, rays, faces);
    if (pairs.sum == 0) return;
    const double factor = contour_exchange(seeing, seen) / static_cast<double>(patch.area);
    if (factor > 0) request.row.add(other, factor * pairs.sum / pairs.tested);
  });
  return rays.traced();
}

}  // namespace

FormFactorMethodInfo contour_integration_method() {
  return {
      .doc =
          "Contour integral of two unoccluded patches, times the visible fraction of random segments. Exact without "
          "occlusion; slow",
      .samples_pairs = true,
      .add_row = add_row_by_contours};
}

}  // namespace etendue::radiosity
