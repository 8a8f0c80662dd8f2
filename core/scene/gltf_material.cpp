// Materials, with the extensions that the surface model knows, and the textures they use.     glTF 2.0,
// sections 3.8, 3.9
#include "scene/gltf_import.h"

namespace etendue::scene::gltf {
namespace {

Wrap wrap_of(int mode) {
  switch (mode) {
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
      return Wrap::clamp;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
      return Wrap::mirror;
    default:
      return Wrap::repeat;
  }
}

Texture import_texture(const Document& document, size_t index) {
  const auto& from = document.model.textures[index];
  Texture texture;
  texture.name = from.name;
  if (from.sampler < 0) return texture;
  const auto& sampler = document.model.samplers[checked_index(from.sampler, document.model.samplers.size(),
                                                              at("textures", index) + ".sampler", "samplers")];
  texture.wrap_u = wrap_of(sampler.wrapS), texture.wrap_v = wrap_of(sampler.wrapT);
  texture.nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
  return texture;
}

float clamped(double x, float low, float high) { return std::clamp(static_cast<float>(x), low, high); }

class MaterialImporter {
 public:
  MaterialImporter(const tinygltf::Material& from, Scene& scene, std::string where)
      : from_(from), scene_(scene), where_(std::move(where)) {}

  Material run() {
    to_.name = from_.name;
    surface();
    emission();
    extensions();
    return to_;
  }

 private:
  void warn(const std::string& what) { scene_.warnings.push_back(where_ + ": " + what); }

  TextureUse use(int texture, int set, const tinygltf::Value* transform, const std::string& member) {
    TextureUse use;
    if (texture < 0) return use;
    use.texture =
        static_cast<int>(checked_index(texture, scene_.textures.size(), where_ + "." + member + ".index", "textures"));
    use.uv_set = set;
    if (transform) {
      use.offset = pair_of(*transform, "offset", use.offset), use.scale = pair_of(*transform, "scale", use.scale);
      use.rotation = number_of(*transform, "rotation", 0);
      use.uv_set = index_of(*transform, "texCoord", set);
    }
    if (use.uv_set > 1) {
      warn(member + " uses TEXCOORD_" + std::to_string(use.uv_set) + "; two sets are read, and set 0 stands in");
      use.uv_set = 0;
    }
    return use;
  }

  // The parser's structs for texture references all have these members.
  template <class Info>
  TextureUse use_of(const Info& info, const char* member) {
    return use(info.index, info.texCoord, extension_of(info.extensions, "KHR_texture_transform"), member);
  }

  // A texture reference inside an extension.
  TextureUse use_in(const tinygltf::Value& extension, const char* member) {
    const auto& info = extension.Get(member);
    if (!info.IsObject()) return {};
    const auto& extensions = info.Get("extensions");
    const bool moved = extensions.IsObject() && extensions.Get("KHR_texture_transform").IsObject();
    return use(index_of(info, "index", -1), index_of(info, "texCoord", 0),
               moved ? &extensions.Get("KHR_texture_transform") : nullptr, member);
  }

  static Vec2 pair_of(const tinygltf::Value& object, const char* member, const Vec2& usual) {
    const auto& pair = object.Get(member);
    if (pair.ArrayLen() != 2) return usual;
    return Vec2(static_cast<float>(pair.Get(0).GetNumberAsDouble()),
                static_cast<float>(pair.Get(1).GetNumberAsDouble()));
  }

  void surface() {
    const auto& pbr = from_.pbrMetallicRoughness;
    const auto& base = pbr.baseColorFactor;
    to_.base_color = Rgb(clamped(base[0], 0, 1), clamped(base[1], 0, 1), clamped(base[2], 0, 1));
    to_.alpha = clamped(base[3], 0, 1);
    to_.metallic = clamped(pbr.metallicFactor, 0, 1), to_.roughness = clamped(pbr.roughnessFactor, 0, 1);
    to_.base_color_texture = use_of(pbr.baseColorTexture, "pbrMetallicRoughness.baseColorTexture");
    to_.metallic_roughness_texture =
        use_of(pbr.metallicRoughnessTexture, "pbrMetallicRoughness.metallicRoughnessTexture");
    to_.normal_texture = use_of(from_.normalTexture, "normalTexture");
    to_.normal_scale = static_cast<float>(from_.normalTexture.scale);
    if (from_.alphaMode == "MASK")
      to_.alpha_mode = AlphaMode::mask;
    else if (from_.alphaMode == "BLEND")
      to_.alpha_mode = AlphaMode::blend;
    else if (from_.alphaMode != "OPAQUE")
      warn("alphaMode is none of OPAQUE, MASK and BLEND; OPAQUE is used");
    to_.alpha_cutoff = std::max(0.0f, static_cast<float>(from_.alphaCutoff));
    to_.double_sided = from_.doubleSided;
  }

  void emission() {
    const auto& factor = from_.emissiveFactor;
    for (int c = 0; c < 3; ++c) to_.emission[c] = std::max(0.0f, static_cast<float>(factor[static_cast<size_t>(c)]));
    to_.emission_texture = use_of(from_.emissiveTexture, "emissiveTexture");
    const auto* strength = extension_of(from_.extensions, "KHR_materials_emissive_strength");
    if (strength) to_.emission *= std::max(0.0f, number_of(*strength, "emissiveStrength", 1));
    if (is_finite(to_.emission)) return;
    warn("its emission is beyond what single precision holds; it emits nothing");
    to_.emission = Rgb(0);
  }

  void extensions() {
    to_.unlit = extension_of(from_.extensions, "KHR_materials_unlit") != nullptr;
    if (const auto* e = extension_of(from_.extensions, "KHR_materials_ior")) {
      to_.ior = number_of(*e, "ior", 1.5f);
      if (to_.ior != 0 && to_.ior < 1) {
        warn("an index of refraction below 1 is taken as 1");
        to_.ior = 1;
      }
    }
    if (const auto* e = extension_of(from_.extensions, "KHR_materials_specular")) {
      to_.specular = clamped(number_of(*e, "specularFactor", 1), 0, 1);
      to_.specular_color = color_of(*e, "specularColorFactor", Rgb(1));
      to_.specular_texture = use_in(*e, "specularTexture");
      to_.specular_color_texture = use_in(*e, "specularColorTexture");
    }
    if (const auto* e = extension_of(from_.extensions, "KHR_materials_transmission")) {
      to_.transmission = clamped(number_of(*e, "transmissionFactor", 0), 0, 1);
      to_.transmission_texture = use_in(*e, "transmissionTexture");
    }
    if (const auto* e = extension_of(from_.extensions, "KHR_materials_volume")) volume(*e);
    if (const auto* e = extension_of(from_.extensions, "KHR_materials_anisotropy")) {
      to_.anisotropy = clamped(number_of(*e, "anisotropyStrength", 0), 0, 1);
      to_.anisotropy_rotation = number_of(*e, "anisotropyRotation", 0);
      to_.anisotropy_texture = use_in(*e, "anisotropyTexture");
    }
  }

  void volume(const tinygltf::Value& e) {
    to_.thickness = std::max(0.0f, number_of(e, "thicknessFactor", 0));
    to_.attenuation_color = color_of(e, "attenuationColor", Rgb(1));
    for (int c = 0; c < 3; ++c) to_.attenuation_color[c] = std::min(to_.attenuation_color[c], 1.0f);
    const float distance = number_of(e, "attenuationDistance", kInfinity);
    to_.attenuation_distance = distance > 0 ? distance : kInfinity;
    if (!(distance > 0)) warn("attenuationDistance has to be above 0; it is taken as infinite");
  }

  const tinygltf::Material& from_;
  Scene& scene_;
  std::string where_;
  Material to_;
};

}  // namespace

const tinygltf::Value* extension_of(const tinygltf::ExtensionMap& extensions, const char* name) {
  const auto found = extensions.find(name);
  return found != extensions.end() && found->second.IsObject() ? &found->second : nullptr;
}

float number_of(const tinygltf::Value& object, const char* member, float usual) {
  const auto& value = object.Get(member);
  return value.IsNumber() ? static_cast<float>(value.GetNumberAsDouble()) : usual;
}

int index_of(const tinygltf::Value& object, const char* member, int usual) {
  const auto& value = object.Get(member);
  return value.IsInt() ? value.GetNumberAsInt() : usual;
}

Rgb color_of(const tinygltf::Value& object, const char* member, const Rgb& usual) {
  const auto& value = object.Get(member);
  if (value.ArrayLen() != 3) return usual;
  Rgb color;
  for (int c = 0; c < 3; ++c) color[c] = std::max(0.0f, static_cast<float>(value.Get(c).GetNumberAsDouble()));
  return color;
}

void import_materials(const Document& document, Scene& scene) {
  for (size_t t = 0; t < document.model.textures.size(); ++t) scene.textures.push_back(import_texture(document, t));
  for (size_t m = 0; m < document.model.materials.size(); ++m)
    scene.materials.push_back(MaterialImporter(document.model.materials[m], scene, at("materials", m)).run());
  Material usual;
  usual.name = "default";
  scene.materials.push_back(usual);
}

}  // namespace etendue::scene::gltf
