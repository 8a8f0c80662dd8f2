#include "scene/gltf/color_textures.h"

namespace etendue::scene::gltf {

std::set<int> color_textures(const Scene& scene) {
  std::set<int> textures;
  for (const Material& m : scene.materials)
    for (const TextureUse* use : {&m.base_color_texture, &m.emission_texture, &m.specular_color_texture,
                                  &m.sheen_color_texture, &m.diffuse_transmission_color_texture})
      textures.insert(use->texture);
  return textures;
}

}  // namespace etendue::scene::gltf
