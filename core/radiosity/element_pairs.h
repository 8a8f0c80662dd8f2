// The pairs of an element with all others that face it, for methods that treat one pair at a time.
#pragma once
#include "base/warp.h"
#include "radiosity/closed_forms.h"
#include "radiosity/form_factors.h"
#include "radiosity/patch_rays.h"

namespace etendue::radiosity {

// The corners of an element, counter-clockwise as seen from its side.
inline Polygon polygon_of(const PatchMesh& mesh, uint32_t element) {
  const Patch& p = mesh.patch_of(element);
  const bool is_ordered = glm::dot(glm::cross(p.p1 - p.p0, p.p2 - p.p0), mesh.normal_of(element)) > 0;
  return is_ordered ? Polygon{p.p0, p.p1, p.p2} : Polygon{p.p0, p.p2, p.p1};
}

// Whether some corner of `other` lies in front of the element, by more than the rounding error.
inline bool has_in_front(const PatchMesh& mesh, uint32_t element, uint32_t other) {
  const Patch &p = mesh.patch_of(element), &q = mesh.patch_of(other);
  const Vec3 normal = mesh.normal_of(element);
  const float margin = p.offset + q.offset;
  return glm::dot(q.p0 - p.p0, normal) > margin || glm::dot(q.p1 - p.p0, normal) > margin ||
         glm::dot(q.p2 - p.p0, normal) > margin;
}

// Calls visit(other) for all elements that may see the element.
template <class Visit>
void for_each_facing(const PatchMesh& mesh, uint32_t element, Visit&& visit) {
  for (uint32_t other = 0; other < mesh.element_count(); ++other)
    if (other / 2 != element / 2 && has_in_front(mesh, element, other) && has_in_front(mesh, other, element))
      visit(other);
}

// A seed for the random numbers of a pair.
inline uint32_t pair_seed(const RowRequest& request, uint32_t other) {
  return hash_combine(element_seed(request.seed, request.element), other);
}

struct VisiblePairs {
  double sum = 0;       // of the weights of the pairs of points that see each other
  uint32_t tested = 0;  // pairs with a positive weight
};
// Draws request.samples pairs of uniform points of the element and another one. weight(from, to) is the weight of a
// pair.
template <class Weight>
VisiblePairs sum_over_pairs(const RowRequest& request, uint32_t other, VisibilityRays& rays, Weight&& weight) {
  const PatchMesh& mesh = request.mesh;
  const Patch &patch = mesh.patch_of(request.element), &target = mesh.patch_of(other);
  VisiblePairs pairs;
  const auto add = [&](double visible) { pairs.sum += visible; };
  for (uint32_t s = 0; s < request.samples; ++s) {
    SampleBlock u;
    request.sampler.block(pair_seed(request, other), s, 0, u);
    const Vec3 from = patch.point(square_to_triangle({u[0], u[1]})),
               to = target.point(square_to_triangle({u[2], u[3]}));
    const double w = weight(from, to);
    if (!(w > 0)) continue;
    ++pairs.tested;
    rays.add(off_surface(mesh, request.element, from), off_surface(mesh, other, to), w, add);
  }
  rays.trace(add);
  return pairs;
}

}  // namespace etendue::radiosity
