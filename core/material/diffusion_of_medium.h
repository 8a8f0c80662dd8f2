// The parameters of diffusion profiles that describe the same body as a medium.                  [Jensen et al. 2001]
#pragma once
#include "bsdf/diffusion/dipole_diffusion.h"
#include "medium/medium.h"

namespace etendue {

struct DiffusionOfMedium {
  Rgb albedo{0};          // diffuse reflectance of a flat half-space for light that has entered
  Rgb mean_free_path{0};  // m; infinite in components that neither scatter nor absorb
};

// By the similarity relation, scattering by the phase function with the mean cosine g equals isotropic scattering with
// the coefficient sigma_s (1 - g). `eta` is the index of refraction of the body.
inline DiffusionOfMedium diffusion_of(const MediumDescription& medium, float eta) {
  const float isotropic = 1 - medium.phase->mean_cosine();
  const float mismatch = boundary_mismatch(eta);
  DiffusionOfMedium result;
  for (int k = 0; k < 3; ++k) {
    const float scattering = medium.scattering[k] * isotropic, extinction = scattering + medium.absorption[k];
    result.mean_free_path[k] = extinction > 0 ? 1 / extinction : kInfinity;
    result.albedo[k] = extinction > 0 ? DipoleDiffusion::albedo_of(scattering, medium.absorption[k], mismatch) : 0;
  }
  return result;
}

}  // namespace etendue
