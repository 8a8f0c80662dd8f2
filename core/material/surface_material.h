// A material in the form that rendering reads: textures resolved to pointers, constant properties found in advance.
#pragma once
#include <memory>
#include <vector>

#include "material/material.h"

namespace etendue {

template <class Color>
class AllLobes;

inline Vec4 clamped(const Vec4& c) { return glm::min(glm::max(c, Vec4(0)), Vec4(1)); }

// The mesh attributes at a surface point that a material reads.
struct TexturePoint {
  Vec2 uv[2]{};   // texture coordinates, by set
  Vec4 color{1};  // vertex colour, linear
  // The width of a pixel of the rendered image in texture coordinates, the smaller one of both sets; only for tiled
  // textures.
  float footprint = 0;
};

struct SurfaceMaterial {
  // A texture with its use by this material. Converts to false if there is no texture.
  struct Map {
    const Texture* texture = nullptr;
    TextureUse use;
    bool identity = true;  // no texture transform
    float scale = 1;       // the smaller scale of the texture transform
    explicit operator bool() const { return texture != nullptr; }
    Vec4 at(const TexturePoint& point, Encoding encoding) const {
      const Vec2 uv = point.uv[use.uv_set];
      return lookup(*texture, encoding, identity ? uv : transformed(use, uv), point.footprint * scale);
    }
    void prefetch(const TexturePoint& point) const {
      const Vec2 uv = point.uv[use.uv_set];
      if (texture) etendue::prefetch(*texture, identity ? uv : transformed(use, uv));
    }
  };

  Material description;  // its emission includes that of its spectrum
  Map base_color, metallic_roughness, normal, emission, specular, specular_color, transmission, anisotropy;

  // Which lobes the surface can have, at any point.
  bool is_lambertian = false;        // at most a Lambertian lobe
  bool uses_standard_lobes = false;  // only lobes of StandardLobes (lobe_set.h)
  bool has_delta_lobes = false;      // a mirror, clear glass, or a smooth layer
  bool is_anisotropic = false;       // f depends on the azimuth
  bool is_opaque = false;            // certainly no lobe transmits light

  // Which inputs shading needs.
  bool has_normal_map = false;       // a normal map of the surface or of its clear coat
  bool has_coat_normal = false;      // a clear coat, on a surface with a normal map: the two normals can differ
  bool needs_tangent_frame = false;  // has_normal_map or is_anisotropic
  bool has_textures = false;
  bool has_tiled_textures = false;  // TexturePoint::footprint is needed
  bool has_alpha = false;           // the alpha mode is mask or blend

  bool is_emissive = false;     // emits, or is unlit
  bool absorbs_inside = false;  // a solid whose inside attenuates light
  bool has_subsurface = false;  // light leaves the surface at other points than it arrives at

  RefractiveIndex inside;  // of a solid

  // Whether light of different wavelengths is refracted into different directions.
  bool disperses() const { return inside.varies(); }

  // Base colour and alpha without texture and vertex colour. If the BSDF model is Lambert's, its albedo is multiplied
  // in.
  Vec4 base_factor{0};
  bool has_constant_base_color = false;  // base_factor times the vertex colour everywhere
  // The lobes of a BSDF model with a constant base colour, for points without vertex colour; else null.
  std::shared_ptr<const AllLobes<Rgb>> constant_lobes = nullptr;
  Subsurface subsurface;  // with has_subsurface

  // The textures of lobes beyond StandardLobes. They stand last to keep the members of common materials together.
  Map clearcoat, clearcoat_roughness, clearcoat_normal, sheen_color, sheen_roughness, iridescence,
      iridescence_thickness, diffuse_transmission, diffuse_transmission_color;

  RgbSpectrum base_spectrum;  // of a Lambertian surface: the reflectance with the colour `base_factor`

  SurfaceMaterial() = default;
  // References the textures, which must outlive the material. A use of a missing or empty texture counts as none.
  SurfaceMaterial(const Material& material, const std::vector<Texture>& textures);

  // Base colour (RGB) and alpha, including texture and vertex colour, clamped to [0, 1]; black for an unlit material.
  Vec4 base_color_at(const TexturePoint& point) const;
  // Starts loading the texels of the maps that most textured materials have.
  void prefetch_texels(const TexturePoint& point) const {
    base_color.prefetch(point);
    metallic_roughness.prefetch(point);
    normal.prefetch(point);
  }
  // The probability that a ray hits the surface here: 0 or 1 for alpha mode mask, alpha for blend.
  float opacity_at(const TexturePoint& point) const;
  // Emitted radiance, W/(m^2 sr).
  Rgb emission_at(const TexturePoint& point) const;
  // The shading normal in the tangent frame of the mesh; (0, 0, 1) without a normal map.
  Vec3 normal_at(const TexturePoint& point) const;
  // The normal of the clear coat in the same frame. The normal map of the surface does not affect it.
  Vec3 coat_normal_at(const TexturePoint& point) const;

 private:
  void resolve_textures(const std::vector<Texture>& textures);
  void classify_model();
  void classify_gltf_surface();
};

}  // namespace etendue
