// The BSDF at a surface point, for a transport model.
#pragma once
#include "bsdf/bsdf.h"
#include "material/gltf_surface.h"
#include "scene/compiled_scene.h"
#include "transport/vertex_bsdf.h"

namespace etendue::transport {

// Sets the relative index of refraction of a boundary between two media. The reflectance of opaque layers, coats and
// thin walls stays that in air.
template <class M>
void set_media(const scene::SurfacePoint& point, Bsdf<M>& bsdf) {
  if (point.instance->solid == scene::kNoSolid) return;
  const float inside = point.inside ? point.inside->eta : 1, outside = point.outside ? point.outside->eta : 1;
  bsdf.lobes.set_relative_eta(inside / outside, outside);
}

// M is a transport model (model_types.h). The BSDF refers to the normals of the point, which must outlive it at the
// same address.
template <class M>
  requires(!M::kScattering)
void build_bsdf(const scene::SurfacePoint& point, Bsdf<M>& bsdf) {
  bsdf.reset(point.shading, point.ng);
  if constexpr (std::is_same_v<typename M::Lobes, AllLobes<typename M::Color>>)
    add_lobes(*point.material, point.texture, bsdf.lobes, point.material->has_coat_normal ? point.coat : Vec3(0, 0, 1));
  else
    add_lobes(*point.material, point.texture, bsdf.lobes);
  if constexpr (M::kMedia) set_media(point, bsdf);
}
template <class M>
  requires(M::kScattering)
void build_bsdf(const scene::SurfacePoint& point, Bsdf<M>& bsdf) {
  build_bsdf<typename M::Surfaces>(point, bsdf.begin_surface());
}

}  // namespace etendue::transport
