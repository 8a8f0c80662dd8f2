#include "bench/reference_key.h"

#include <span>
#include <type_traits>

#include "base/file.h"
#include "base/hash.h"
#include "image/tiled_image.h"

namespace etendue::bench {
namespace {

// Increment when the same settings render a different image.
constexpr uint64_t kVersion = 2;

class Hasher {
 public:
  template <class T>
  void add(const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto bytes = std::as_bytes(std::span(values));
    hash_ = hash_bytes(reinterpret_cast<const char*>(bytes.data()), bytes.size(), hash_);
  }
  void add(const std::string& text) { hash_ = hash_bytes(text.data(), text.size(), hash_); }
  void add(uint64_t number) { hash_ = mix_bits(hash_ ^ mix_bits(number + kVersion)); }
  uint64_t value() const { return hash_; }

 private:
  uint64_t hash_ = hash_bytes("picture", 7);
};

void add(Hasher& h, const image::Image* image) {
  if (!image) return h.add(uint64_t{0});
  h.add(static_cast<uint64_t>(image->width));
  h.add(static_cast<uint64_t>(image->height));
  h.add(image->bytes);
  h.add(image->floats);
}

void add(Hasher& h, const Mesh& mesh) {
  h.add(mesh.positions);
  h.add(mesh.triangles);
  h.add(mesh.normals);
  h.add(mesh.tangents);
  h.add(mesh.uvs[0]);
  h.add(mesh.uvs[1]);
  h.add(mesh.colors);
}

void add(Hasher& h, const scene::Animation& animation) {
  for (const auto& channel : animation.channels) {
    h.add(channel.times);
    h.add(channel.values);
  }
}

// Hashes the data that may be stored in separate files next to the scene file.
void add_arrays(Hasher& h, const scene::Scene& scene) {
  for (const auto& group : scene.meshes)
    for (const auto& primitive : group.primitives) {
      add(h, *primitive.mesh);
      h.add(static_cast<uint64_t>(primitive.material));
      if (!primitive.deformation) continue;
      for (const auto& target : primitive.deformation->targets) {
        h.add(target.positions);
        h.add(target.normals);
      }
      h.add(primitive.deformation->joints);
      h.add(primitive.deformation->weights);
    }
  for (const auto& texture : scene.textures) {
    add(h, texture.image.get());
    if (texture.tiles) h.add(texture.tiles->hash);
  }
  for (const auto& skin : scene.skins) h.add(skin->inverse_bind);
  for (const auto& animation : scene.animations) add(h, *animation);
  add(h, scene.environment.map.get());
}

}  // namespace

uint64_t image_key(const render::Document& document) {
  Hasher h;
  h.add(kVersion);
  // The file contains what settings do not: the assignment of textures and the node hierarchy.
  if (!document.scene->file.empty())
    if (const auto bytes = read_file(document.scene->file)) h.add(*bytes);
  add_arrays(h, *document.scene);
  render::Document bare = document;
  bare.scene_name = "";
  bare.camera_name = "";
  bare.seed = 0;
  bare.limits = {};
  bare.display = {};
  bare.fireflies = {};
  bare.origin = nullptr;  // so that state_json lists all settings instead of the changed ones
  auto scene = std::make_shared<scene::Scene>(*document.scene);
  scene->environment.file.clear();
  bare.scene = std::move(scene);
  h.add(render::state_json(bare, 0));
  return h.value();
}

}  // namespace etendue::bench
