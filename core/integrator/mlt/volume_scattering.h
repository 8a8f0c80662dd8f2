// The scattering medium at a point, for vertices in volumes.
#pragma once
#include "scene/compiled_scene.h"

namespace etendue::integrator {

struct VolumeScattering {
  const PhaseFunction* phase = nullptr;
  Rgb scattering{0}, extinction{0};  // 1/m
};

inline VolumeScattering scattering_of(const HomogeneousMedium* medium, const HeterogeneousMedium* heterogeneous,
                                      const Vec3& position) {
  if (!heterogeneous) return {medium->phase.get(), medium->scattering, medium->extinction};
  const float density = heterogeneous->grid->density(heterogeneous->in_grid(position));
  return {heterogeneous->phase.get(), heterogeneous->scattering * density, heterogeneous->extinction * density};
}

// At a collision in these solids, or in the atmosphere.
inline VolumeScattering scattering_at(const scene::Solids& solids, const scene::MediumStack& stack,
                                      const Vec3& position) {
  if (const scene::Solid* solid = solids.find(stack.top()))
    return scattering_of(&solid->medium, solid->heterogeneous.get(), position);
  const scene::AtmosphereMedium& atmosphere = *solids.atmosphere();
  return scattering_of(&atmosphere.medium, atmosphere.heterogeneous.get(), position);
}

}  // namespace etendue::integrator
