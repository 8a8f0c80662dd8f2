// A material as a user edits it: the parameters of a surface, named as in glTF 2.0 and its extensions.
//
// The meaning is that of [glTF 2.0, appendix B]: mix(dielectric, metal, metallic), where dielectric is a specular layer
// over a diffuse or transmitting base. The scene compiler turns a Material into a SurfaceMaterial (surface_material.h),
// from which a BSDF is built at each hit.
//
// Texture values multiply the factors. Comments on textures give the encoding and the channel that is read.
#pragma once
#include <string>

#include "base/vec.h"
#include "bsdf/bsdf_model.h"
#include "bsdf/lobes/layered_base.h"
#include "material/texture.h"
#include "medium/medium.h"
#include "spectrum/emission_spectrum.h"
#include "spectrum/refractive_index.h"
#include "spectrum/rgb.h"

namespace etendue {

enum class AlphaMode : uint8_t { opaque, mask, blend };

struct Material {
  std::string name;

  // A BSDF model in place of the glTF surface. Base colour, opacity, normal map, emission and attenuation apply to it
  // as well; the other parameters below do not.
  BsdfModelRef model;

  Rgb base_color{1};
  float alpha = 1;
  TextureUse base_color_texture;  // sRGB, alpha in A
  float metallic = 1, roughness = 1;
  TextureUse metallic_roughness_texture;  // linear, G roughness, B metallic
  TextureUse normal_texture;              // linear, tangent space
  float normal_scale = 1;

  Rgb emission{0};              // emissiveFactor * emissiveStrength: radiance, cd/m^2
  TextureUse emission_texture;  // sRGB
  EmissionSpectrumRef emission_spectrum;  // ETENDUE_transport; its RGB value multiplies the emission

  AlphaMode alpha_mode = AlphaMode::opaque;
  float alpha_cutoff = 0.5f;
  bool double_sided = false;
  // How the layers attenuate what lies below them.
  Layering layering = Layering::gltf;
  bool unlit = false;  // KHR_materials_unlit: shows the base colour independent of the light

  float ior = 1.5f;    // KHR_materials_ior; 0 means a Fresnel term of 1
  float dispersion = 0;       // KHR_materials_dispersion: 20 / Abbe number; only solids disperse light
  Glass glass = Glass::none;  // ETENDUE_transport: index of refraction by wavelength, in place of `dispersion`
  float specular = 1;         // KHR_materials_specular
  Rgb specular_color{1};
  TextureUse specular_texture;        // linear, A
  TextureUse specular_color_texture;  // sRGB
  float transmission = 0;             // KHR_materials_transmission
  TextureUse transmission_texture;    // linear, R
  float thickness = 0;                // KHR_materials_volume; 0 is a thin wall, other values mean a solid
  Rgb attenuation_color{1};
  float attenuation_distance = kInfinity;         // m, in world space
  // ETENDUE_transport. The medium inside a solid, in addition to the attenuation above, which is absorption.
  MediumDescription medium;
  // The surface only bounds the medium: light passes it without reflection or refraction, and its index of refraction
  // is 1.
  bool boundary_only = false;
  // Where solids overlap, the one with the higher priority is the medium; equal priorities: see scene/solids.h.
  int medium_priority = 0;
  float anisotropy = 0, anisotropy_rotation = 0;  // KHR_materials_anisotropy; [0, 1]; radians from the tangent, ccw
  TextureUse anisotropy_texture;                  // linear, RG direction, B strength

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
  float iridescence_thickness_min = 100;          // nm, where the texture is 0
  float iridescence_thickness_max = 400;          // nm, where the texture is 1 or missing
  TextureUse iridescence_texture;                 // linear, R
  TextureUse iridescence_thickness_texture;       // linear, G
  float diffuse_transmission = 0;                 // KHR_materials_diffuse_transmission
  Rgb diffuse_transmission_color{1};
  TextureUse diffuse_transmission_texture;        // linear, A
  TextureUse diffuse_transmission_color_texture;  // sRGB

  // KHR_materials_pbrSpecularGlossiness: base_color is the diffuse colour, specular_color the reflectance at normal
  // incidence, roughness one minus the glossiness. specular_color_texture (sRGB, RGB) and metallic_roughness_texture
  // (linear, A: glossiness) are the same image.
  bool specular_glossiness = false;

  // Whether light enters a solid body, whose inside attenuates it.
  bool is_solid() const {
    if (boundary_only) return true;
    return model ? model->is_solid() : (transmission > 0 || diffuse_transmission > 0) && thickness > 0;
  }
  // The index of refraction inside a solid.
  RefractiveIndex inside_index() const {
    // Stands for an index of 0, which means a reflectance of one.
    constexpr float kPerfectMirrorIor = 1e4f;
    if (boundary_only) return {};
    if (model) return {model->index_of_refraction(), dispersion, Glass::none};
    return ior == 0 ? RefractiveIndex{kPerfectMirrorIor} : RefractiveIndex{ior, dispersion, glass};
  }
  bool is_emissive() const { return !is_black(emission); }

  friend bool operator==(const Material&, const Material&) = default;
};

}  // namespace etendue
