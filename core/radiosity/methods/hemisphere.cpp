// Hemisphere sampling                                                             [Lang, sec. 10.1.4, eq. 10.91-10.93]
//
// Cosine-distributed rays from points of the element: F_ij is the fraction of the rays whose first hit is on element j.
// The standard deviation of N independent rays is sqrt(F (1 - F) / N). All factors of a row share the rays, and their
// sum is at most 1.
#include "base/frame.h"
#include "base/warp.h"
#include "radiosity/form_factors.h"
#include "radiosity/patch_rays.h"

namespace etendue::radiosity {
namespace {

uint64_t add_row_by_hemisphere(const RowRequest& request) {
  const PatchMesh& mesh = request.mesh;
  const Patch& patch = mesh.patch_of(request.element);
  const Frame frame(mesh.normal_of(request.element));
  const uint32_t seed = element_seed(request.seed, request.element);
  HitRays rays(request.scene, mesh, seed);
  const double weight = 1.0 / request.samples;
  const auto count = [&](uint32_t element, float) {
    if (element != request.element) request.row.add(element, weight);
  };
  for (uint32_t s = 0; s < request.samples; ++s) {
    SampleBlock u;
    request.sampler.block(seed, s, 0, u);
    const Vec3 origin = off_surface(mesh, request.element, patch.point(square_to_triangle({u[0], u[1]})));
    rays.add(origin, frame.to_world(square_to_cosine_hemisphere({u[2], u[3]})), 1, count);
  }
  rays.trace(count);
  return rays.traced();
}

}  // namespace

FormFactorMethodInfo hemisphere_method() {
  return {.doc = "Cosine-distributed rays from the patch. Accurate in any scene; rows sum to 1 in closed scenes",
          .samples_pairs = false,
          .add_row = add_row_by_hemisphere};
}

}  // namespace etendue::radiosity
