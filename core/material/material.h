// What a user edits: the parameters of a surface, as glTF 2.0 and its extensions name them.
//
// The meaning is that of the Khronos specification, appendix B: mix(dielectric, metal, metallic), with
// dielectric = fresnel_mix(ior, diffuse or transmitted base, specular layer). `compile` of the scene turns it into what
// shading reads; at a hit it becomes a Bsdf.
#pragma once
#include <string>

#include "base/vec.h"
#include "bsdf/bsdf_model.h"
#include "material/texture.h"
#include "spectrum/rgb.h"

namespace etendue {

enum class AlphaMode : uint8_t { opaque, mask, blend };

struct Material {
  std::string name;

  // Instead of the surface that the numbers below describe; base colour, opacity, normal map, emission and the inside
  // of a solid count for it too.
  BsdfModelRef model;

  Rgb base_color{1};
  float alpha = 1;
  TextureUse base_color_texture;  // sRGB, alpha in A
  float metallic = 1, roughness = 1;
  TextureUse metallic_roughness_texture;  // linear: G roughness, B metallic
  TextureUse normal_texture;              // linear, tangent space
  float normal_scale = 1;

  Rgb emission{0};              // emissiveFactor * emissiveStrength: radiance W/(m^2 sr)
  TextureUse emission_texture;  // sRGB

  AlphaMode alpha_mode = AlphaMode::opaque;
  float alpha_cutoff = 0.5f;
  bool double_sided = false;
  bool unlit = false;  // KHR_materials_unlit: shows base colour, whatever the light

  float ior = 1.5f;    // KHR_materials_ior; 0 means a Fresnel term of one
  float specular = 1;  // KHR_materials_specular
  Rgb specular_color{1};
  TextureUse specular_texture;        // linear, A
  TextureUse specular_color_texture;  // sRGB
  float transmission = 0;             // KHR_materials_transmission
  TextureUse transmission_texture;    // linear, R
  float thickness = 0;                // KHR_materials_volume: 0 is a thin wall, anything else a solid
  Rgb attenuation_color{1};
  float attenuation_distance = kInfinity;         // metres of world space
  float anisotropy = 0, anisotropy_rotation = 0;  // [0, 1]; radians from the tangent, counter-clockwise
  TextureUse anisotropy_texture;                  // linear: RG direction, B strength

  float clearcoat = 0, clearcoat_roughness = 0;  // KHR_materials_clearcoat
  TextureUse clearcoat_texture;                  // linear, R
  TextureUse clearcoat_roughness_texture;        // linear, G
  TextureUse clearcoat_normal_texture;           // linear, tangent space
  float clearcoat_normal_scale = 1;
  Rgb sheen_color{0};  // KHR_materials_sheen
  float sheen_roughness = 0;
  TextureUse sheen_color_texture;                 // sRGB
  TextureUse sheen_roughness_texture;             // linear, A
  float iridescence = 0, iridescence_ior = 1.3f;  // KHR_materials_iridescence
  float iridescence_thickness_min = 100;          // nanometres, where the texture is 0
  float iridescence_thickness_max = 400;          // nanometres, where it is 1 or missing
  TextureUse iridescence_texture;                 // linear, R
  TextureUse iridescence_thickness_texture;       // linear, G
  float diffuse_transmission = 0;                 // KHR_materials_diffuse_transmission
  Rgb diffuse_transmission_color{1};
  TextureUse diffuse_transmission_texture;        // linear, A
  TextureUse diffuse_transmission_color_texture;  // sRGB

  // KHR_materials_pbrSpecularGlossiness: base_color is the diffuse colour, specular_color the reflectance at normal
  // incidence, roughness one minus glossiness; specular_color_texture (RGB, sRGB) and metallic_roughness_texture (A,
  // linear: glossiness) are the same picture.
  bool specular_glossiness = false;

  bool is_solid() const {
    return model ? model->is_solid() : (transmission > 0 || diffuse_transmission > 0) && thickness > 0;
  }
  bool is_emissive() const { return !is_black(emission); }

  friend bool operator==(const Material&, const Material&) = default;
};

}  // namespace etendue
