// The BSDF at a point of a surface, for a transport model.
#pragma once
#include "bsdf/bsdf.h"
#include "material/gltf_surface.h"
#include "scene/compiled_scene.h"

namespace etendue::transport {

// Boundaries of solids refract by the ratio of the media on both sides. What glTF's opaque layers, coats and thin walls
// reflect is as it is in air.
template <class M>
void set_media(const scene::SurfacePoint& point, Bsdf<M>& bsdf) {
  if (point.instance->solid == scene::kNoSolid || !point.outside) return;
  const float inside = point.inside ? point.inside->eta : 1;
  bsdf.lobes.set_relative_eta(inside / point.outside->eta, point.outside->eta);
}

// M is a transport model (model_types.h). The BSDF refers to the point's normals: the point must outlive it and stay in
// its place.
template <class M>
void build_bsdf(const scene::SurfacePoint& point, Bsdf<M>& bsdf) {
  bsdf.reset(point.shading, point.ng);
  if constexpr (std::is_same_v<typename M::Lobes, AllLobes<typename M::Color>>)
    add_lobes(*point.material, point.texture, bsdf.lobes, point.material->has_coat_normal ? point.coat : Vec3(0, 0, 1));
  else
    add_lobes(*point.material, point.texture, bsdf.lobes);
  if constexpr (M::kMedia) set_media(point, bsdf);
}

}  // namespace etendue::transport
