// Textures, samplers, and pictures as PNG.
#include "scene/gltf/jobs.h"
#include "scene/gltf/output.h"
#include "spectrum/rgb.h"

namespace etendue::scene::gltf {
namespace {

int wrap_code(Wrap wrap) {
  switch (wrap) {
    case Wrap::clamp:
      return TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
    case Wrap::mirror:
      return TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT;
    default:
      return TINYGLTF_TEXTURE_WRAP_REPEAT;
  }
}

Json sampler_of(const Texture& texture) {
  Json sampler = Json::object();
  if (texture.wrap_u != Wrap::repeat) sampler["wrapS"] = wrap_code(texture.wrap_u);
  if (texture.wrap_v != Wrap::repeat) sampler["wrapT"] = wrap_code(texture.wrap_v);
  if (texture.nearest) sampler["magFilter"] = TINYGLTF_TEXTURE_FILTER_NEAREST;
  return sampler;
}

// The textures that are looked up as sRGB.
std::set<int> color_textures(const Scene& scene) {
  std::set<int> textures;
  for (const Material& m : scene.materials)
    for (const TextureUse* use : {&m.base_color_texture, &m.emission_texture, &m.specular_color_texture,
                                  &m.sheen_color_texture, &m.diffuse_transmission_color_texture})
      textures.insert(use->texture);
  return textures;
}

// Float pictures are linear; as sRGB they have to be encoded. Alpha never is.
image::Image encoded_as_srgb(image::Image picture) {
  const auto channels = static_cast<size_t>(picture.channels);
  const bool alpha = channels % 2 == 0;
  for (size_t i = 0; i < picture.floats.size(); ++i)
    if (!alpha || i % channels + 1 != channels) picture.floats[i] = linear_to_srgb(picture.floats[i]);
  return picture;
}

struct Picture {
  std::shared_ptr<const image::Image> image;
  bool srgb = false;
  std::string name;
  std::vector<std::byte> png;
};

void encode(Picture& picture) {
  const bool floats = picture.image->type == image::PixelType::float32;
  auto png =
      floats && picture.srgb ? image::encode_png(encoded_as_srgb(*picture.image)) : image::encode_png(*picture.image);
  if (!png) throw Unusable{picture.name + ": " + png.error().message};
  picture.png = std::move(*png);
}

}  // namespace

void write_textures(Output& out) {
  std::vector<Picture> pictures;
  std::map<std::pair<const image::Image*, bool>, size_t> known;
  std::map<std::string, int> samplers;
  const std::set<int> colors = color_textures(out.scene);
  for (size_t t = 0; t < out.scene.textures.size(); ++t) {
    const Texture& texture = out.scene.textures[t];
    Json to = Json::object();
    put_name(to, texture.name);
    if (const Json sampler = sampler_of(texture); !sampler.empty()) {
      const auto [place, added] = samplers.try_emplace(sampler.dump(), 0);
      if (added) place->second = out.add("samplers", sampler);
      to["sampler"] = place->second;
    }
    if (texture.image) {
      const bool floats = texture.image->type == image::PixelType::float32;
      const bool srgb = floats && colors.contains(static_cast<int>(t));
      const auto [place, added] = known.try_emplace({texture.image.get(), srgb}, pictures.size());
      if (added) pictures.push_back({texture.image, srgb, at("textures", t), {}});
      if (added && floats)
        out.warnings.push_back(at("textures", t) + ": its picture of floats is limited to 0 to 1 and to 16 bits");
      to["source"] = place->second;
    }
    out.add("textures", std::move(to));
  }
  run_jobs(
      pictures.size(), [&](size_t i) { encode(pictures[i]); }, [](float) { return true; });
  for (Picture& picture : pictures) out.pictures.push_back(std::move(picture.png));
}

}  // namespace etendue::scene::gltf
