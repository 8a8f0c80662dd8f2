// Materials, textures and images.                                                        glTF 2.0, sections 3.8, 3.9
#include <filesystem>
#include <future>

#include "image/image.h"
#include "scene/gltf_document.h"

namespace etendue::scene::gltf {
namespace {

Wrap wrap_of(int mode) {
  if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Wrap::clamp;
  return mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Wrap::mirror : Wrap::repeat;
}

// The bytes of an image wherever they lie; empty if they cannot be had.
std::span<const std::byte> bytes_of(const Document& d, size_t i) {
  const auto& image = d.model.images[i];
  if (image.bufferView >= 0 && static_cast<size_t>(image.bufferView) < d.model.bufferViews.size()) {
    const auto& view = d.model.bufferViews[static_cast<size_t>(image.bufferView)];
    const auto& data = d.model.buffers[static_cast<size_t>(view.buffer)].data;
    return std::as_bytes(std::span(data).subspan(view.byteOffset, view.byteLength));
  }
  if (i < d.image_files.size()) return std::as_bytes(std::span(d.image_files[i]));
  return {};
}

std::string image_name(const Document& d, size_t i) {
  const auto& image = d.model.images[i];
  const std::string name = !image.uri.empty() ? image.uri : image.name;
  return at("images", i) + (name.empty() ? "" : " '" + name.substr(0, 80) + "'");
}

// Decoded side by side: a large scene's pictures take longer than its triangles.
std::vector<std::shared_ptr<const image::Image>> decode_images(const Document& d, Scene& scene) {
  std::vector<std::future<Result<image::Image>>> work;
  for (size_t i = 0; i < d.model.images.size(); ++i)
    work.push_back(std::async(std::launch::async, [&d, i]() -> Result<image::Image> {
      const auto bytes = bytes_of(d, i);
      if (bytes.empty()) return input_error(image_name(d, i) + ": its file cannot be read");
      return image::decode_image(bytes, image_name(d, i));
    }));
  std::vector<std::shared_ptr<const image::Image>> images;
  for (auto& w : work) {
    auto decoded = w.get();
    if (!decoded) scene.warnings.push_back(decoded.error().message + "; left out");
    images.push_back(decoded ? std::make_shared<const image::Image>(std::move(*decoded)) : nullptr);
  }
  return images;
}

int texture_source(const tinygltf::Texture& texture) {
  if (const auto* webp = extension_of(texture.extensions, "EXT_texture_webp")) return static_cast<int>(number_of(*webp, "source", -1));
  return texture.source;
}

void apply_transform(const tinygltf::Value* transform, TextureUse& use) {
  if (!transform) return;
  const auto pair = [&](const char* key, Vec2 usual) {
    const auto& v = transform->Get(key);
    if (!v.IsArray() || v.ArrayLen() != 2 || !v.Get(0).IsNumber() || !v.Get(1).IsNumber()) return usual;
    return Vec2(static_cast<float>(v.Get(0).GetNumberAsDouble()), static_cast<float>(v.Get(1).GetNumberAsDouble()));
  };
  use.offset = pair("offset", use.offset), use.scale = pair("scale", use.scale);
  use.rotation = number_of(*transform, "rotation", 0);
  use.uv_set = static_cast<int>(number_of(*transform, "texCoord", static_cast<float>(use.uv_set)));
}

TextureUse checked_use(TextureUse use, const Scene& scene, const std::string& where, std::vector<std::string>& warnings) {
  use.texture = checked_index(use.texture, scene.textures.size(), where, "textures");
  if (use.uv_set < 0 || use.uv_set > 1) {
    warnings.push_back(where + ": texture coordinates " + std::to_string(use.uv_set) + " are not supported; set 0 is used");
    use.uv_set = 0;
  }
  return use;
}

// A texture reference: tinygltf's own structs all have index, texCoord and extensions.
template <class Info>
TextureUse use_of(const Info& info, Scene& scene, const std::string& where) {
  TextureUse use;
  use.texture = info.index, use.uv_set = info.texCoord;
  apply_transform(extension_of(info.extensions, "KHR_texture_transform"), use);
  return checked_use(use, scene, where, scene.warnings);
}

TextureUse use_in(const tinygltf::Value& extension, const char* key, Scene& scene, const std::string& where) {
  const auto& info = extension.Get(key);
  if (!info.IsObject()) return {};
  TextureUse use;
  use.texture = static_cast<int>(number_of(info, "index", -1)), use.uv_set = static_cast<int>(number_of(info, "texCoord", 0));
  const auto& extensions = info.Get("extensions");
  if (extensions.IsObject() && extensions.Has("KHR_texture_transform")) apply_transform(&extensions.Get("KHR_texture_transform"), use);
  return checked_use(use, scene, where + "." + key, scene.warnings);
}

float clamped(double x, double low, double high) { return static_cast<float>(std::isfinite(x) ? std::clamp(x, low, high) : low); }

void import_extensions(const tinygltf::Material& from, Material& m, Scene& scene, const std::string& where) {
  const auto& extensions = from.extensions;
  if (const auto* e = extension_of(extensions, "KHR_materials_emissive_strength")) m.emission *= std::max(0.0f, number_of(*e, "emissiveStrength", 1));
  if (extension_of(extensions, "KHR_materials_unlit")) m.unlit = true;
  if (const auto* e = extension_of(extensions, "KHR_materials_ior")) {
    m.ior = number_of(*e, "ior", 1.5f);
    if (m.ior != 0 && m.ior < 1) {
      scene.warnings.push_back(where + ": an index of refraction below 1 is taken as 1");
      m.ior = 1;
    }
  }
  if (const auto* e = extension_of(extensions, "KHR_materials_specular")) {
    m.specular = clamped(number_of(*e, "specularFactor", 1), 0, 1);
    m.specular_color = color_of(*e, "specularColorFactor", Rgb(1));
    m.specular_texture = use_in(*e, "specularTexture", scene, where);
    m.specular_color_texture = use_in(*e, "specularColorTexture", scene, where);
  }
  if (const auto* e = extension_of(extensions, "KHR_materials_transmission")) {
    m.transmission = clamped(number_of(*e, "transmissionFactor", 0), 0, 1);
    m.transmission_texture = use_in(*e, "transmissionTexture", scene, where);
  }
  if (const auto* e = extension_of(extensions, "KHR_materials_volume")) {
    m.thickness = std::max(0.0f, number_of(*e, "thicknessFactor", 0));
    m.attenuation_color = color_of(*e, "attenuationColor", Rgb(1));
    const float distance = number_of(*e, "attenuationDistance", kInfinity);
    m.attenuation_distance = distance > 0 ? distance : kInfinity;
  }
  if (const auto* e = extension_of(extensions, "KHR_materials_anisotropy")) {
    m.anisotropy = clamped(number_of(*e, "anisotropyStrength", 0), 0, 1);
    m.anisotropy_rotation = number_of(*e, "anisotropyRotation", 0);
  }
}

Material import_material(const tinygltf::Material& from, Scene& scene, const std::string& where) {
  Material m;
  m.name = from.name;
  const auto& pbr = from.pbrMetallicRoughness;
  const auto& base = pbr.baseColorFactor;
  if (base.size() == 4) {
    m.base_color = {clamped(base[0], 0, 1), clamped(base[1], 0, 1), clamped(base[2], 0, 1)};
    m.alpha = clamped(base[3], 0, 1);
  }
  m.metallic = clamped(pbr.metallicFactor, 0, 1), m.roughness = clamped(pbr.roughnessFactor, 0, 1);
  m.base_color_texture = use_of(pbr.baseColorTexture, scene, where + ".baseColorTexture");
  m.metallic_roughness_texture = use_of(pbr.metallicRoughnessTexture, scene, where + ".metallicRoughnessTexture");
  m.normal_texture = use_of(from.normalTexture, scene, where + ".normalTexture");
  m.normal_scale = clamped(from.normalTexture.scale, -100, 100);
  m.emission_texture = use_of(from.emissiveTexture, scene, where + ".emissiveTexture");
  const auto& e = from.emissiveFactor;
  if (e.size() == 3) m.emission = {clamped(e[0], 0, 1e9), clamped(e[1], 0, 1e9), clamped(e[2], 0, 1e9)};
  m.alpha_mode = from.alphaMode == "MASK" ? AlphaMode::mask : from.alphaMode == "BLEND" ? AlphaMode::blend : AlphaMode::opaque;
  m.alpha_cutoff = clamped(from.alphaCutoff, 0, 1e9);
  m.double_sided = from.doubleSided;
  import_extensions(from, m, scene, where);
  return m;
}

}  // namespace

const tinygltf::Value* extension_of(const tinygltf::ExtensionMap& extensions, const char* name) {
  const auto found = extensions.find(name);
  return found != extensions.end() && found->second.IsObject() ? &found->second : nullptr;
}

float number_of(const tinygltf::Value& object, const char* key, float usual) {
  const auto& v = object.Get(key);
  if (!v.IsNumber()) return usual;
  const auto x = static_cast<float>(v.GetNumberAsDouble());
  return std::isfinite(x) ? x : usual;
}

Rgb color_of(const tinygltf::Value& object, const char* key, const Rgb& usual) {
  const auto& v = object.Get(key);
  if (!v.IsArray() || v.ArrayLen() != 3) return usual;
  Rgb c;
  for (int i = 0; i < 3; ++i) {
    if (!v.Get(i).IsNumber()) return usual;
    c[i] = clamped(v.Get(i).GetNumberAsDouble(), 0, 1e9);
  }
  return c;
}

void import_textures(const Document& d, Scene& scene) {
  const auto images = decode_images(d, scene);
  for (size_t i = 0; i < d.model.textures.size(); ++i) {
    const auto& from = d.model.textures[i];
    const int source = checked_index(texture_source(from), images.size(), at("textures", i) + ".source", "images");
    const int sampler = checked_index(from.sampler, d.model.samplers.size(), at("textures", i) + ".sampler", "samplers");
    Texture texture;
    if (source >= 0) texture.image = images[static_cast<size_t>(source)];
    texture.name = from.name;
    if (sampler >= 0) {
      const auto& s = d.model.samplers[static_cast<size_t>(sampler)];
      texture.wrap_u = wrap_of(s.wrapS), texture.wrap_v = wrap_of(s.wrapT);
      texture.nearest = s.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
    }
    scene.textures.push_back(std::move(texture));
  }
}

void import_materials(const Document& d, Scene& scene) {
  for (size_t i = 0; i < d.model.materials.size(); ++i) scene.materials.push_back(import_material(d.model.materials[i], scene, at("materials", i)));
  Material usual;
  usual.name = "default";
  scene.materials.push_back(usual);
}

}  // namespace etendue::scene::gltf
