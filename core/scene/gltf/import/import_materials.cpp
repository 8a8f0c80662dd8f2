// Imports materials with their extensions, and textures.                              glTF 2.0, sections 3.8 and 3.9
#include <charconv>
#include <cmath>
#include <limits>

#include "base/number_text.h"
#include "scene/gltf/import/importers.h"

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

Texture import_texture(const InputFile& input, size_t index) {
  const auto& from = input.model.textures[index];
  Texture texture;
  texture.name = from.name;
  if (from.sampler < 0) return texture;
  const auto& sampler = input.model.samplers[checked_index(from.sampler, input.model.samplers.size(),
                                                           at("textures", index) + ".sampler", "samplers")];
  texture.wrap_u = wrap_of(sampler.wrapS);
  texture.wrap_v = wrap_of(sampler.wrapT);
  texture.nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
  return texture;
}

// The shortest decimal text that reads as the same float.
std::string shortest(float x) {
  std::array<char, 32> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), x).ptr};
}

// Corresponds to an Abbe number of 0.2; no known medium is near it.
constexpr float kLargestDispersion = 100;

class MaterialImporter {
 public:
  MaterialImporter(const InputFile& input, const tinygltf::Material& from, Scene& scene, std::string where)
      : input_(input), from_(from), scene_(scene), where_(std::move(where)) {}

  Material run() {
    to_.name = from_.name;
    surface();
    emission();
    extensions();
    return to_;
  }

 private:
  void warn(const std::string& what) { scene_.warnings.push_back(where_ + ": " + what); }

  // The value clamped to the range, with a warning if that changes it.
  float limited(double x, float low, float high, const std::string& member) {
    const auto value = static_cast<float>(x);
    const float clamped = std::clamp(value, low, high);
    if (clamped != value)
      warn(member + " is " + shortest(value) + "; it has to be " +
           (high < kInfinity ? "between " + shortest(low) + " and " + shortest(high) : "at least " + shortest(low)) +
           "; " + shortest(clamped) + " is used");
    return clamped;
  }
  Rgb limited(const Rgb& color, float high, const std::string& member) {
    Rgb clamped;
    for (int c = 0; c < 3; ++c) clamped[c] = limited(color[c], 0, high, member + "[" + std::to_string(c) + "]");
    return clamped;
  }
  // A factor in [0, 1].
  float factor_in(const tinygltf::Value& extension, const char* member, float fallback) {
    return limited(number_or(extension, member, fallback), 0, 1, member);
  }
  Rgb color_in(const tinygltf::Value& extension, const char* member, const Rgb& fallback, float high = 1) {
    return limited(color_or(extension, member, fallback), high, member);
  }

  TextureUse use(int texture, int set, const tinygltf::Value* transform, const std::string& member) {
    TextureUse use;
    if (texture < 0) return use;
    use.texture =
        static_cast<int>(checked_index(texture, scene_.textures.size(), where_ + "." + member + ".index", "textures"));
    use.uv_set = set;
    if (transform) {
      use.offset = pair_of(*transform, "offset", use.offset);
      use.scale = pair_of(*transform, "scale", use.scale);
      use.rotation = number_or(*transform, "rotation", 0);
      use.uv_set = index_or(*transform, "texCoord", set);
    }
    if (use.uv_set > 1) {
      warn(member + " uses TEXCOORD_" + std::to_string(use.uv_set) +
           "; only sets 0 and 1 are supported; set 0 is used");
      use.uv_set = 0;
    }
    return use;
  }

  // `Info` is any of tinygltf's structs for texture references, which share these members.
  template <class Info>
  TextureUse use_of(const Info& info, const char* member) {
    return use(info.index, info.texCoord, find_extension(info.extensions, "KHR_texture_transform"), member);
  }

  // A texture reference inside an extension.
  TextureUse use_in(const tinygltf::Value& extension, const char* member) {
    const auto& info = extension.Get(member);
    if (!info.IsObject()) return {};
    const auto& extensions = info.Get("extensions");
    const bool transformed = extensions.IsObject() && extensions.Get("KHR_texture_transform").IsObject();
    return use(index_or(info, "index", -1), index_or(info, "texCoord", 0),
               transformed ? &extensions.Get("KHR_texture_transform") : nullptr, member);
  }

  static Vec2 pair_of(const tinygltf::Value& object, const char* member, const Vec2& fallback) {
    const auto& pair = object.Get(member);
    if (pair.ArrayLen() != 2) return fallback;
    return Vec2(static_cast<float>(pair.Get(0).GetNumberAsDouble()),
                static_cast<float>(pair.Get(1).GetNumberAsDouble()));
  }

  void surface() {
    const auto& pbr = from_.pbrMetallicRoughness;
    const auto& base = pbr.baseColorFactor;
    to_.base_color = limited(Rgb(base[0], base[1], base[2]), 1, "pbrMetallicRoughness.baseColorFactor");
    to_.alpha = limited(base[3], 0, 1, "pbrMetallicRoughness.baseColorFactor[3]");
    to_.metallic = limited(pbr.metallicFactor, 0, 1, "pbrMetallicRoughness.metallicFactor");
    to_.roughness = limited(pbr.roughnessFactor, 0, 1, "pbrMetallicRoughness.roughnessFactor");
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
      warn("alphaMode has to be OPAQUE, MASK or BLEND; OPAQUE is used");
    to_.alpha_cutoff = limited(from_.alphaCutoff, 0, kInfinity, "alphaCutoff");
    to_.double_sided = from_.doubleSided;
  }

  void emission() {
    const auto& factor = from_.emissiveFactor;
    to_.emission = limited(Rgb(factor[0], factor[1], factor[2]), kInfinity, "emissiveFactor");
    to_.emission_texture = use_of(from_.emissiveTexture, "emissiveTexture");
    const auto* strength = find_extension(from_.extensions, "KHR_materials_emissive_strength");
    if (strength)
      to_.emission *= limited(number_or(*strength, "emissiveStrength", 1), 0, kInfinity, "emissiveStrength");
    if (is_finite(to_.emission)) return;
    warn("emissiveFactor times emissiveStrength overflows single precision; the material emits nothing");
    to_.emission = Rgb(0);
  }

  void extensions() {
    to_.model = import_bsdf_model(from_.extensions, where_, scene_.warnings);
    to_.layering = import_layering(from_.extensions, where_, scene_.warnings);
    to_.unlit = find_extension(from_.extensions, "KHR_materials_unlit") != nullptr;
    if (const auto* e = find_extension(from_.extensions, "KHR_materials_ior")) {
      to_.ior = number_or(*e, "ior", 1.5f);
      if (to_.ior != 0 && to_.ior < 1) {
        warn("ior is below 1; 1 is used");
        to_.ior = 1;
      }
    }
    if (const auto* e = find_extension(from_.extensions, "KHR_materials_dispersion"))
      to_.dispersion = limited(number_or(*e, "dispersion", 0), 0, kLargestDispersion, "dispersion");
    to_.glass = import_glass(from_.extensions, where_, scene_.warnings);
    to_.emission_spectrum = import_emission_spectrum(input_, from_.extensions, where_, scene_.warnings);
    if (const auto* e = find_extension(from_.extensions, "KHR_materials_specular")) specular(*e);
    if (const auto* e = find_extension(from_.extensions, "KHR_materials_transmission")) {
      to_.transmission = factor_in(*e, "transmissionFactor", 0);
      to_.transmission_texture = use_in(*e, "transmissionTexture");
    }
    if (const auto* e = find_extension(from_.extensions, "KHR_materials_volume")) volume(*e);
    import_volume_scatter(from_.extensions, where_, to_, scene_.warnings);
    import_medium(input_, from_.extensions, where_, to_, scene_.warnings);
    if (const auto* e = find_extension(from_.extensions, "KHR_materials_anisotropy")) {
      to_.anisotropy = factor_in(*e, "anisotropyStrength", 0);
      to_.anisotropy_rotation = number_or(*e, "anisotropyRotation", 0);
      to_.anisotropy_texture = use_in(*e, "anisotropyTexture");
    }
    if (const auto* e = find_extension(from_.extensions, "KHR_materials_clearcoat")) clearcoat(*e);
    if (const auto* e = find_extension(from_.extensions, "KHR_materials_sheen")) sheen(*e);
    if (const auto* e = find_extension(from_.extensions, "KHR_materials_iridescence")) iridescence(*e);
    if (const auto* e = find_extension(from_.extensions, "KHR_materials_diffuse_transmission"))
      diffuse_transmission(*e);
    if (const auto* e = find_extension(from_.extensions, "KHR_materials_pbrSpecularGlossiness"))
      specular_glossiness(*e);
  }

  void specular(const tinygltf::Value& e) {
    to_.specular = factor_in(e, "specularFactor", 1);
    to_.specular_color = color_in(e, "specularColorFactor", Rgb(1), kInfinity);
    to_.specular_texture = use_in(e, "specularTexture");
    to_.specular_color_texture = use_in(e, "specularColorTexture");
  }

  void volume(const tinygltf::Value& e) {
    to_.thickness = limited(number_or(e, "thicknessFactor", 0), 0, kInfinity, "thicknessFactor");
    to_.attenuation_color = color_in(e, "attenuationColor", Rgb(1));
    const float distance = number_or(e, "attenuationDistance", kInfinity);
    to_.attenuation_distance = distance > 0 ? distance : kInfinity;
    if (!(distance > 0)) warn("attenuationDistance has to be above 0; infinity is used");
  }

  void clearcoat(const tinygltf::Value& e) {
    to_.clearcoat = factor_in(e, "clearcoatFactor", 0);
    to_.clearcoat_texture = use_in(e, "clearcoatTexture");
    to_.clearcoat_roughness = factor_in(e, "clearcoatRoughnessFactor", 0);
    to_.clearcoat_roughness_texture = use_in(e, "clearcoatRoughnessTexture");
    to_.clearcoat_normal_texture = use_in(e, "clearcoatNormalTexture");
    if (to_.clearcoat_normal_texture.texture >= 0)
      to_.clearcoat_normal_scale = number_or(e.Get("clearcoatNormalTexture"), "scale", 1);
  }

  void sheen(const tinygltf::Value& e) {
    to_.sheen_color = color_in(e, "sheenColorFactor", Rgb(0));
    to_.sheen_color_texture = use_in(e, "sheenColorTexture");
    to_.sheen_roughness = factor_in(e, "sheenRoughnessFactor", 0);
    to_.sheen_roughness_texture = use_in(e, "sheenRoughnessTexture");
  }

  // The minimum may exceed the maximum: it is the thickness where the texture is 0.
  void iridescence(const tinygltf::Value& e) {
    to_.iridescence = factor_in(e, "iridescenceFactor", 0);
    to_.iridescence_texture = use_in(e, "iridescenceTexture");
    to_.iridescence_ior = limited(number_or(e, "iridescenceIor", 1.3f), 1, kInfinity, "iridescenceIor");
    const auto thickness = [&](const char* member, float fallback) {
      return limited(number_or(e, member, fallback), 0, kInfinity, member);
    };
    to_.iridescence_thickness_min = thickness("iridescenceThicknessMinimum", to_.iridescence_thickness_min);
    to_.iridescence_thickness_max = thickness("iridescenceThicknessMaximum", to_.iridescence_thickness_max);
    to_.iridescence_thickness_texture = use_in(e, "iridescenceThicknessTexture");
  }

  void diffuse_transmission(const tinygltf::Value& e) {
    to_.diffuse_transmission = factor_in(e, "diffuseTransmissionFactor", 0);
    to_.diffuse_transmission_texture = use_in(e, "diffuseTransmissionTexture");
    to_.diffuse_transmission_color = color_in(e, "diffuseTransmissionColorFactor", Rgb(1));
    to_.diffuse_transmission_color_texture = use_in(e, "diffuseTransmissionColorTexture");
  }

  // Computed in double precision, so that a roughness that was saved as glossiness is restored exactly.
  float roughness_in(const tinygltf::Value& e) {
    const auto& glossiness = e.Get("glossinessFactor");
    const float roughness = glossiness.IsNumber() ? static_cast<float>(1 - glossiness.GetNumberAsDouble()) : 0.0f;
    if (!(roughness >= 0 && roughness <= 1)) return 1 - factor_in(e, "glossinessFactor", 1);
    return roughness;
  }

  // Replaces metallic-roughness. The extension excludes the newer ones, so specular and its texture are reset.
  void specular_glossiness(const tinygltf::Value& e) {
    to_.specular_glossiness = true;
    const auto& diffuse = e.Get("diffuseFactor");
    const auto component = [&](int i) {
      return diffuse.ArrayLen() == 4 ? static_cast<float>(diffuse.Get(i).GetNumberAsDouble()) : 1.0f;
    };
    to_.base_color = limited(Rgb(component(0), component(1), component(2)), 1, "diffuseFactor");
    to_.alpha = limited(component(3), 0, 1, "diffuseFactor[3]");
    to_.base_color_texture = use_in(e, "diffuseTexture");
    to_.specular_color = color_in(e, "specularFactor", Rgb(1));
    to_.metallic = 0;
    to_.roughness = roughness_in(e);
    to_.specular_color_texture = to_.metallic_roughness_texture = use_in(e, "specularGlossinessTexture");
    to_.specular = 1;
    to_.specular_texture = {};
  }

  const InputFile& input_;
  const tinygltf::Material& from_;
  Scene& scene_;
  std::string where_;
  Material to_;
};

}  // namespace

const tinygltf::Value* find_extension(const tinygltf::ExtensionMap& extensions, const char* name) {
  const auto found = extensions.find(name);
  return found != extensions.end() && found->second.IsObject() ? &found->second : nullptr;
}

const tinygltf::Value& member_of(const tinygltf::Value& value, const char* name) {
  static const tinygltf::Value kNull;
  return value.IsObject() ? value.Get(name) : kNull;
}

float number_or(const tinygltf::Value& object, const char* member, float fallback) {
  const auto& value = member_of(object, member);
  return value.IsNumber() ? static_cast<float>(value.GetNumberAsDouble()) : fallback;
}

std::optional<float> number_in_range(const tinygltf::Value& object, const char* member, float low, float high,
                                     const std::string& where, std::vector<std::string>& warnings) {
  const auto& value = member_of(object, member);
  const float x = value.IsNumber() ? static_cast<float>(value.GetNumberAsDouble()) : NAN;
  if (x >= low && x <= high) return x;
  constexpr float kLargest = std::numeric_limits<float>::max();
  std::string range;
  if (high < kLargest)
    range = " from " + format_number(low, 6) + " to " + format_number(high, 6);
  else if (low > -kLargest)
    range = " of at least " + format_number(low, 6);
  warnings.push_back(where + "." + member + ": has to be a number" + range + "; it is ignored");
  return std::nullopt;
}

int index_or(const tinygltf::Value& object, const char* member, int fallback) {
  const auto& value = member_of(object, member);
  return value.IsInt() ? value.GetNumberAsInt() : fallback;
}

Rgb color_or(const tinygltf::Value& object, const char* member, const Rgb& fallback) {
  const auto& value = member_of(object, member);
  if (value.ArrayLen() != 3) return fallback;
  Rgb color;
  for (int c = 0; c < 3; ++c) color[c] = static_cast<float>(value.Get(c).GetNumberAsDouble());
  return color;
}

void import_materials(const InputFile& input, Scene& scene) {
  for (size_t t = 0; t < input.model.textures.size(); ++t) scene.textures.push_back(import_texture(input, t));
  for (size_t m = 0; m < input.model.materials.size(); ++m)
    scene.materials.push_back(MaterialImporter(input, input.model.materials[m], scene, at("materials", m)).run());
  Material default_material;
  default_material.name = "default";
  scene.materials.push_back(default_material);
}

}  // namespace etendue::scene::gltf
