// Exports materials. Members and extensions with default values are omitted.
#include "scene/gltf/export/output_file.h"

namespace etendue::scene::gltf {
namespace {

class MaterialExporter {
 public:
  MaterialExporter(OutputFile& out, const Material& material) : out_(out), m_(material) {}

  Json run() {
    put_name(to_, m_.name);
    surface();
    emission();
    specular();
    transmission();
    layers();
    if (m_.unlit) out_.extend(to_, "KHR_materials_unlit");
    export_bsdf_model(out_, m_.model, to_);
    export_layering(out_, m_.layering, to_);
    export_glass(out_, m_.glass, to_);
    export_emission_spectrum(out_, m_.emission_spectrum, to_);
    export_medium(out_, m_, to_);
    return std::move(to_);
  }

 private:
  Json reference(const TextureUse& use) {
    Json info{{"index", use.texture}};
    if (use.uv_set != 0) info["texCoord"] = use.uv_set;
    if (use.offset == Vec2(0) && use.scale == Vec2(1) && use.rotation == 0) return info;
    Json& transform = out_.extend(info, "KHR_texture_transform");
    if (use.offset != Vec2(0)) transform["offset"] = vector(use.offset);
    if (use.scale != Vec2(1)) transform["scale"] = vector(use.scale);
    put(transform, "rotation", use.rotation, 0);
    return info;
  }
  void put_texture(Json& object, const char* member, const TextureUse& use) {
    if (use.texture >= 0) object[member] = reference(use);
  }
  void put_normal(Json& object, const char* member, const TextureUse& use, float scale) {
    put_texture(object, member, use);
    if (use.texture >= 0) put(object[member], "scale", scale, 1);
  }
  static void put_color(Json& object, const char* member, const Rgb& color, const Rgb& default_value) {
    if (color != default_value) object[member] = vector(color);
  }
  // Adds an extension unless it has no members.
  void extend(const char* extension, const Json& members) {
    if (!members.empty()) out_.extend(to_, extension) = members;
  }

  Vec4 with_alpha() const { return {m_.base_color[0], m_.base_color[1], m_.base_color[2], m_.alpha}; }

  void surface() {
    Json pbr = Json::object();
    const Vec4 base = with_alpha();
    if (base != Vec4(1)) pbr["baseColorFactor"] = vector(base);
    put_texture(pbr, "baseColorTexture", m_.base_color_texture);
    put(pbr, "metallicFactor", m_.metallic, 1);
    put(pbr, "roughnessFactor", m_.roughness, 1);
    if (!m_.specular_glossiness) put_texture(pbr, "metallicRoughnessTexture", m_.metallic_roughness_texture);
    if (!pbr.empty()) to_["pbrMetallicRoughness"] = std::move(pbr);
    put_normal(to_, "normalTexture", m_.normal_texture, m_.normal_scale);
    if (m_.alpha_mode != AlphaMode::opaque) to_["alphaMode"] = m_.alpha_mode == AlphaMode::mask ? "MASK" : "BLEND";
    if (m_.alpha_mode == AlphaMode::mask) put(to_, "alphaCutoff", m_.alpha_cutoff, 0.5f);
    if (m_.double_sided) to_["doubleSided"] = true;
  }

  // The factor must not exceed 1. The strength is a power of two, so that their product is exact.
  void emission() {
    put_texture(to_, "emissiveTexture", m_.emission_texture);
    const float largest = max_component(m_.emission);
    if (!(largest > 0)) return;
    const float strength = largest > 1 ? std::exp2(std::ceil(std::log2(largest))) : 1;
    const bool in_range = std::isfinite(strength);
    to_["emissiveFactor"] = vector(in_range ? m_.emission / strength : m_.emission);
    if (in_range && strength != 1)
      out_.extend(to_, "KHR_materials_emissive_strength")["emissiveStrength"] = number(strength);
  }

  void specular() {
    Json specular = Json::object(), ior = Json::object(), dispersion = Json::object(),
         anisotropy = Json::object();
    if (m_.specular_glossiness) {
      Json& e = out_.extend(to_, "KHR_materials_pbrSpecularGlossiness");
      if (const Vec4 diffuse = with_alpha(); diffuse != Vec4(1)) e["diffuseFactor"] = vector(diffuse);
      put_texture(e, "diffuseTexture", m_.base_color_texture);
      put_color(e, "specularFactor", m_.specular_color, Rgb(1));
      if (m_.roughness != 0) e["glossinessFactor"] = 1 - static_cast<double>(m_.roughness);
      put_texture(e, "specularGlossinessTexture", m_.specular_color_texture);
    } else {
      put(specular, "specularFactor", m_.specular, 1);
      put_color(specular, "specularColorFactor", m_.specular_color, Rgb(1));
      put_texture(specular, "specularTexture", m_.specular_texture);
      put_texture(specular, "specularColorTexture", m_.specular_color_texture);
    }
    extend("KHR_materials_specular", specular);
    put(ior, "ior", m_.ior, 1.5f);
    extend("KHR_materials_ior", ior);
    put(dispersion, "dispersion", m_.dispersion, 0);
    extend("KHR_materials_dispersion", dispersion);
    put(anisotropy, "anisotropyStrength", m_.anisotropy, 0);
    put(anisotropy, "anisotropyRotation", m_.anisotropy_rotation, 0);
    put_texture(anisotropy, "anisotropyTexture", m_.anisotropy_texture);
    extend("KHR_materials_anisotropy", anisotropy);
  }

  void transmission() {
    Json transmission = Json::object(), volume = Json::object(), diffuse = Json::object();
    put(transmission, "transmissionFactor", m_.transmission, 0);
    put_texture(transmission, "transmissionTexture", m_.transmission_texture);
    extend("KHR_materials_transmission", transmission);
    put(volume, "thicknessFactor", m_.thickness, 0);
    put_color(volume, "attenuationColor", m_.attenuation_color, Rgb(1));
    if (std::isfinite(m_.attenuation_distance)) volume["attenuationDistance"] = number(m_.attenuation_distance);
    extend("KHR_materials_volume", volume);
    put(diffuse, "diffuseTransmissionFactor", m_.diffuse_transmission, 0);
    put_texture(diffuse, "diffuseTransmissionTexture", m_.diffuse_transmission_texture);
    put_color(diffuse, "diffuseTransmissionColorFactor", m_.diffuse_transmission_color, Rgb(1));
    put_texture(diffuse, "diffuseTransmissionColorTexture", m_.diffuse_transmission_color_texture);
    extend("KHR_materials_diffuse_transmission", diffuse);
  }

  void layers() {
    Json coat = Json::object(), sheen = Json::object(), film = Json::object();
    put(coat, "clearcoatFactor", m_.clearcoat, 0);
    put_texture(coat, "clearcoatTexture", m_.clearcoat_texture);
    put(coat, "clearcoatRoughnessFactor", m_.clearcoat_roughness, 0);
    put_texture(coat, "clearcoatRoughnessTexture", m_.clearcoat_roughness_texture);
    put_normal(coat, "clearcoatNormalTexture", m_.clearcoat_normal_texture, m_.clearcoat_normal_scale);
    extend("KHR_materials_clearcoat", coat);
    put_color(sheen, "sheenColorFactor", m_.sheen_color, Rgb(0));
    put_texture(sheen, "sheenColorTexture", m_.sheen_color_texture);
    put(sheen, "sheenRoughnessFactor", m_.sheen_roughness, 0);
    put_texture(sheen, "sheenRoughnessTexture", m_.sheen_roughness_texture);
    extend("KHR_materials_sheen", sheen);
    put(film, "iridescenceFactor", m_.iridescence, 0);
    put_texture(film, "iridescenceTexture", m_.iridescence_texture);
    put(film, "iridescenceIor", m_.iridescence_ior, 1.3f);
    put(film, "iridescenceThicknessMinimum", m_.iridescence_thickness_min, 100);
    put(film, "iridescenceThicknessMaximum", m_.iridescence_thickness_max, 400);
    put_texture(film, "iridescenceThicknessTexture", m_.iridescence_thickness_texture);
    extend("KHR_materials_iridescence", film);
  }

  OutputFile& out_;
  const Material& m_;
  Json to_ = Json::object();
};

// Whether this is the material that the importer appends for primitives without one.
bool is_default(const Material& material) {
  Material default_material;
  default_material.name = "default";
  return material == default_material;
}

// Whether a variant uses the material.
bool is_used_by_variant(const Scene& scene, int material) {
  for (const MeshGroup& mesh : scene.meshes)
    for (const Primitive& primitive : mesh.primitives)
      if (primitive.choices.size() > 1 &&
          std::find(primitive.choices.begin() + 1, primitive.choices.end(), material) != primitive.choices.end())
        return true;
  return false;
}

}  // namespace

int material_index(const Scene& scene, int material) {
  const bool last = static_cast<size_t>(material) + 1 == scene.materials.size();
  return last && is_default(scene.materials.back()) && !is_used_by_variant(scene, material) ? -1 : material;
}

void export_materials(OutputFile& out) {
  for (size_t m = 0; m < out.scene.materials.size(); ++m)
    if (material_index(out.scene, static_cast<int>(m)) >= 0)
      out.add("materials", MaterialExporter(out, out.scene.materials[m]).run());
}

}  // namespace etendue::scene::gltf
