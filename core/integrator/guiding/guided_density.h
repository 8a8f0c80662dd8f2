// The density of guided directions at a vertex, for MIS weights of techniques that do not sample there.
#pragma once
#include "integrator/guiding/radiance_guide.h"

namespace etendue::guiding {

class GuidedDensity {
 public:
  GuidedDensity() = default;
  // `has_non_delta_lobe`: of the BSDF at the vertex.
  GuidedDensity(const RadianceGuide& guide, const Vec3& position, bool has_non_delta_lobe) {
    const Region& region = guide.region(guide.region_at(position));
    if (has_non_delta_lobe && region.is_ready()) region_ = &region;
  }

  // The density per solid angle of the mixture of BSDF and guide, where the BSDF has `bsdf_pdf`.
  float pdf(const Vec3& wi, float bsdf_pdf) const {
    return region_ ? region_->mixture(bsdf_pdf, region_->guide_pdf(sphere_to_square(wi))) : bsdf_pdf;
  }

 private:
  const Region* region_ = nullptr;  // null: the BSDF alone
};

}  // namespace etendue::guiding
