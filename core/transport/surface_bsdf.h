// The BSDF at a point of a surface, for a transport model.
#pragma once
#include "bsdf/bsdf.h"
#include "material/gltf_surface.h"
#include "scene/compiled_scene.h"

namespace etendue::transport {

// M is a transport model (model_types.h). The BSDF refers to the point's normals: the point must outlive it and stay in
// its place.
template <class M>
void build_bsdf(const scene::SurfacePoint& point, Bsdf<M>& bsdf) {
  bsdf.reset(point.shading, point.ng);
  if constexpr (std::is_same_v<typename M::Lobes, AllLobes<typename M::Color>>)
    add_lobes(*point.material, point.texture, bsdf.lobes, point.material->has_coat_normal ? point.coat : Vec3(0, 0, 1));
  else
    add_lobes(*point.material, point.texture, bsdf.lobes);
}

}  // namespace etendue::transport
