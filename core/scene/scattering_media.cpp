#include <algorithm>

#include "scene/scene.h"

namespace etendue::scene {

bool has_scattering_media(const Scene& scene) {
  if (!scene.atmosphere.medium.is_clear()) return true;
  return std::ranges::any_of(scene.materials, [](const Material& m) { return m.is_solid() && m.medium.is_volume(); });
}

}  // namespace etendue::scene
