// A ball of one material under a light that shows what it is made of: what a material editor looks at.
#pragma once
#include "base/parameter.h"
#include "camera/camera.h"
#include "scene/scene.h"

namespace etendue::scene {

// Furnace: radiance one from everywhere, in which a surface that neither takes nor makes light cannot be seen.
enum class PreviewLight : uint8_t { studio, furnace, lamp, scene };

// `from` lends its textures, its variant of the material's own, and for PreviewLight::scene its environment.
Scene preview_scene(const Scene& from, const Material& material, PreviewLight light);

// Sees the ball and a little around it.
Camera preview_camera();

}  // namespace etendue::scene

template <>
struct etendue::Options<etendue::scene::PreviewLight> {
  static constexpr std::array<etendue::Option, 4> kOptions{
      {{"studio", "Studio"}, {"furnace", "Furnace"}, {"lamp", "One small lamp"}, {"scene", "The scene's own sky"}}};
};
