// Imports cameras and punctual lights.                             glTF 2.0, section 3.10; KHR_lights_punctual
#include <algorithm>
#include <limits>

#include "scene/coordinate_range.h"
#include "scene/gltf/import/importers.h"

namespace etendue::scene::gltf {
namespace {

Camera import_camera(const tinygltf::Camera& from, const std::string& where, std::vector<std::string>& warnings) {
  Camera camera;
  camera.name = from.name;
  double near = 0, far = 0, aspect = 0;
  if (from.type == "orthographic") {
    const auto& o = from.orthographic;
    camera.projection = Projection::orthographic;
    near = o.znear, far = o.zfar;
    camera.ymag = std::abs(static_cast<float>(o.ymag));
    if (o.ymag != 0) aspect = std::abs(o.xmag / o.ymag);
    if (!(camera.ymag > 0 && camera.ymag <= kMaxCoordinate)) {
      warnings.push_back(where + ".orthographic.ymag: has to be between 0 and 1e9; 1 is used");
      camera.ymag = 1;
    }
  } else {
    const auto& p = from.perspective;
    near = p.znear, far = p.zfar, aspect = p.aspectRatio;
    camera.yfov = static_cast<float>(p.yfov);
    if (!(camera.yfov > 0 && camera.yfov < kPi)) {
      warnings.push_back(where + ".perspective.yfov: has to be between 0 and pi; 0.8 is used");
      camera.yfov = 0.8f;
    }
  }
  constexpr double kMaxAspect = 1000;
  if (aspect >= 1 / kMaxAspect && aspect <= kMaxAspect) camera.aspect = static_cast<float>(aspect);
  // Clipping planes at the smallest and largest float mean none: exporters write them where glTF requires a value.
  if (static_cast<float>(near) > std::numeric_limits<float>::min()) camera.near_clip = static_cast<float>(near);
  // zfar is 0 if it is missing: the projection is infinite.
  if (far > 0 && static_cast<float>(far) < std::numeric_limits<float>::max()) camera.far_clip = static_cast<float>(far);
  if (!(camera.far_clip > camera.near_clip)) {
    warnings.push_back(where + ": zfar has to be greater than znear; both are ignored");
    camera.near_clip = 0;
    camera.far_clip = kInfinity;
  }
  return camera;
}

Light import_light(const tinygltf::Light& from, const std::string& where, std::vector<std::string>& warnings) {
  const LightTypeInfo* type = find_light_type(from.type);
  if (!type || !type->description.punctual)
    fail(where + ".type", "'" + from.type.substr(0, 40) + "' has to be point, spot or directional");
  Light light = make_light(from.type);
  light.name = from.name;
  if (from.color.size() == 3)
    for (int c = 0; c < 3; ++c) light.color[c] = std::max(0.0f, static_cast<float>(from.color[static_cast<size_t>(c)]));
  light.set("intensity", double{std::max(0.0f, static_cast<float>(from.intensity))});
  if (from.range > 0) light.set("range", from.range);
  if (!light.parameter("outer-cone")) return light;
  const auto inner = static_cast<float>(from.spot.innerConeAngle);
  const auto outer = static_cast<float>(from.spot.outerConeAngle);
  const float outer_cone = std::clamp(outer, 1e-3f, kPi / 2);
  const float inner_cone = std::clamp(inner, 0.0f, outer_cone);
  light.set("outer-cone", double{outer_cone});
  light.set("inner-cone", double{inner_cone});
  constexpr float kRounding = 1e-4f;
  if (std::abs(outer_cone - outer) > kRounding || std::abs(inner_cone - inner) > kRounding)
    warnings.push_back(where + ".spot: the cone angles have to satisfy 0 <= inner < outer <= pi/2; they were clamped");
  return light;
}

}  // namespace

void import_cameras(const InputFile& input, Scene& scene) {
  for (size_t i = 0; i < input.model.cameras.size(); ++i) {
    scene.cameras.push_back(import_camera(input.model.cameras[i], at("cameras", i), scene.warnings));
    import_camera_extension(input.model.cameras[i].extensions, at("cameras", i), scene.cameras.back(), scene.warnings);
  }
}

void import_lights(const InputFile& input, Scene& scene) {
  for (size_t i = 0; i < input.model.lights.size(); ++i) {
    scene.lights.push_back(import_light(input.model.lights[i], at("lights", i), scene.warnings));
    import_light_extension(input, input.model.lights[i].extensions, at("lights", i), scene.lights.back(),
                           scene.warnings);
  }
}

}  // namespace etendue::scene::gltf
