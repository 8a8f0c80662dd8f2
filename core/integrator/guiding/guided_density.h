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
    if (!region_) return bsdf_pdf;
    const float guided = region_->guide.pdf(sphere_to_square(wi)) * (0.25f * kInvPi);
    return (1 - region_->fraction) * bsdf_pdf + region_->fraction * guided;
  }

 private:
  const Region* region_ = nullptr;  // null: the BSDF alone
};

}  // namespace etendue::guiding
