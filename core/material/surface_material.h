// From a Material to what shading reads: textures looked up at a hit, numbers brought into their ranges, lobes chosen.
#pragma once
#include <memory>
#include <vector>

#include "material/material.h"

namespace etendue {

template <class Color>
class AllLobes;

inline Vec4 clamped(const Vec4& c) { return glm::min(glm::max(c, Vec4(0)), Vec4(1)); }

// Where on a mesh the material is looked at.
struct TexturePoint {
  Vec2 uv[2]{};
  Vec4 color{1};  // the vertex colour
};

// A material as the sampling loop sees it: textures resolved to pointers, what is constant known to be so.
struct SurfaceMaterial {
  Material description;
  struct Map {
    const Texture* texture = nullptr;
    TextureUse use;
    bool identity = true;  // no texture transform
    explicit operator bool() const { return texture != nullptr; }
    Vec4 at(const TexturePoint& point, Encoding encoding) const {
      const Vec2 uv = point.uv[use.uv_set];
      return lookup(*texture, encoding, identity ? uv : transformed(use, uv));
    }
  };
  Map base_color, metallic_roughness, normal, emission, specular, specular_color, transmission, anisotropy;
  bool has_normal_map = false;           // has a normal map, of its own or of its coat
  bool is_anisotropic = false;           // looks different when it is turned about its normal
  bool needs_tangent_frame = false;      // any of the two: not just any frame about the geometric normal will do
  bool is_lambertian = false;            // never anything but a Lambertian lobe
  bool uses_standard_lobes = false;      // never anything but the lobes of StandardLobes
  bool has_delta_lobes = false;          // it can be smooth: a mirror, or clear glass
  bool absorbs_inside = false;           // a solid whose inside takes light away
  bool has_constant_base_color = false;  // its base colour is `factor` but for vertex colours
  Vec4 base_factor{0};
  // The lobes of a reflection model where its base colour is the same everywhere.
  std::shared_ptr<const AllLobes<Rgb>> constant_lobes = nullptr;
  bool is_emissive = false;      // emits, or is unlit
  bool has_alpha = false;        // its opacity is not one everywhere
  bool has_textures = false;     // looks at texture coordinates or vertex colours
  bool has_coat_normal = false;  // a clear coat whose normal is not the shading normal
  // Of what needs AllLobes.
  Map clearcoat, clearcoat_roughness, clearcoat_normal, sheen_color, sheen_roughness, iridescence,
      iridescence_thickness, diffuse_transmission, diffuse_transmission_color;

  SurfaceMaterial() = default;
  SurfaceMaterial(const Material& material, const std::vector<Texture>& textures);

  // Base colour and opacity, vertex colour included.
  Vec4 base_at(const TexturePoint& point) const;
  // The probability that a ray stops here: 0 or 1 for a mask, alpha for blending.
  float opacity_at(const TexturePoint& point) const;
  Rgb emission_at(const TexturePoint& point) const;
  // The shading normal in the tangent frame of the mesh; (0, 0, 1) without a normal map.
  Vec3 normal_at(const TexturePoint& point) const;
  // The same of the clear coat, which the base's normal map does not bend.
  Vec3 coat_normal_at(const TexturePoint& point) const;

 private:
  void resolve(const std::vector<Texture>& textures);
  void prepare_model();
  void look_at_gltf();
};

}  // namespace etendue
