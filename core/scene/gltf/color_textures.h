#pragma once
#include <set>

#include "scene/scene.h"

namespace etendue::scene::gltf {

// The textures that a material reads as sRGB colours.
std::set<int> color_textures(const Scene& scene);

}  // namespace etendue::scene::gltf
