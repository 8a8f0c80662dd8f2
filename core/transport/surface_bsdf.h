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

// Whether the media at a surface point refract the wavelengths into different directions.
inline bool disperses(const scene::SurfacePoint& point) {
  if (point.instance->solid == scene::kNoSolid) return point.material->disperses();
  return (point.inside && point.inside->index.varies()) || (point.outside && point.outside->index.varies());
}

// The same as set_media at one wavelength in nm. Needed also for a dispersive solid around which paths store no media.
inline void set_media_at(const scene::SurfacePoint& point, float wavelength, AllLobes<Rgb>& lobes) {
  const auto index = [&](const scene::Solid* solid) { return solid ? solid->index.at(wavelength) : 1; };
  if (point.instance->solid != scene::kNoSolid) {
    const float outside = index(point.outside);
    lobes.set_relative_eta(index(point.inside) / outside, outside);
  } else if (point.material->disperses()) {
    lobes.set_relative_eta(point.material->inside.at(wavelength), 1);
  }
}

// M is a transport model (model_types.h). The BSDF refers to the normals of the point, which must outlive it at the
// same address.
template <class M>
requires(!M::kScattering && !M::kSpectral) void build_bsdf(const scene::SurfacePoint& point, Bsdf<M>& bsdf) {
  bsdf.reset(point.shading, point.ng);
  if constexpr (std::is_same_v<typename M::Lobes, AllLobes<typename M::Color>>)
    add_lobes(*point.material, point.texture, bsdf.lobes, point.material->has_coat_normal ? point.coat : Vec3(0, 0, 1));
  else
    add_lobes(*point.material, point.texture, bsdf.lobes);
  if constexpr (M::kMedia) set_media(point, bsdf);
}
template <class M>
requires(M::kScattering && !M::kSpectral) void build_bsdf(const scene::SurfacePoint& point, Bsdf<M>& bsdf) {
  build_bsdf<typename M::Surfaces>(point, bsdf.begin_surface());
}

// The same in the spectral model. The BSDF refers to the wavelengths, too.
template <class M>
requires(M::kSpectral && !M::kScattering) void build_bsdf(const scene::SurfacePoint& point,
                                                          const Wavelengths& wavelengths, Bsdf<M>& bsdf) {
  bsdf.rebind(point.shading, point.ng);
  if (M::kDiffuse || point.material->is_lambertian) {
    if (point.material->has_constant_base_color && point.texture.color == Vec4(1))
      return bsdf.lobes.assign_lambertian(point.material->base_spectrum.at(wavelengths));
    const Vec4 base = point.material->base_color_at(point.texture);
    return bsdf.lobes.assign_lambertian(uplift_reflectance(Rgb(base.x, base.y, base.z), wavelengths));
  }
  if constexpr (!M::kDiffuse) {
    AllLobes<Rgb> lobes;
    add_lobes(*point.material, point.texture, lobes, point.material->has_coat_normal ? point.coat : Vec3(0, 0, 1));
    set_media_at(point, wavelengths.hero(), lobes);
    bsdf.lobes.assign(lobes, wavelengths);
  }
}
template <class M>
requires(M::kSpectral&& M::kScattering) void build_bsdf(const scene::SurfacePoint& point,
                                                        const Wavelengths& wavelengths, Bsdf<M>& bsdf) {
  build_bsdf<typename M::Surfaces>(point, wavelengths, bsdf.begin_surface());
}

}  // namespace etendue::transport
