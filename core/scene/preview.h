// The preview of a material editor: a sphere with one material under a choice of illumination.
#pragma once
#include "base/parameter.h"
#include "camera/camera.h"
#include "scene/scene.h"

namespace etendue::scene {

// furnace: uniform radiance 1 from all directions, in which an energy-conserving surface that does not absorb is
// invisible.
enum class PreviewLight : uint8_t { studio, furnace, area_light, scene };

// Uses the textures of `from`, and its environment for PreviewLight::scene.
Scene preview_scene(const Scene& from, const Material& material, PreviewLight light);

// A camera that frames the sphere.
Camera preview_camera();

}  // namespace etendue::scene

template <>
struct etendue::Options<etendue::scene::PreviewLight> {
  static constexpr std::array<etendue::Option, 4> kOptions{{{"studio", "Studio"},
                                                            {"furnace", "Furnace"},
                                                            {"lamp", "Small area light"},
                                                            {"scene", "Environment of the scene"}}};
};
