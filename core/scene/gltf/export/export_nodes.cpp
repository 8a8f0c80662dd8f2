// Exports nodes, cameras and lights.
#include <limits>

#include "light/light.h"
#include "scene/gltf/export/output_file.h"
#include "scene/gltf/transport_extension.h"

namespace etendue::scene::gltf {
namespace {

// Clipping planes of a camera without them, where glTF requires values.
constexpr float kNoNear = std::numeric_limits<float>::min(), kNoFar = std::numeric_limits<float>::max();

Json camera_of(OutputFile& out, const Camera& camera) {
  Json to = Json::object();
  put_name(to, camera.name);
  const bool perspective = camera.projection == Projection::perspective;
  to["type"] = perspective ? "perspective" : "orthographic";
  Json& projection = to[to["type"].get<std::string>()];
  projection["znear"] = number(camera.near_clip > 0 ? camera.near_clip : kNoNear);
  if (std::isfinite(camera.far_clip) || !perspective)
    projection["zfar"] = number(std::isfinite(camera.far_clip) ? camera.far_clip : kNoFar);
  if (perspective) {
    projection["yfov"] = number(camera.yfov);
    if (camera.aspect > 0) projection["aspectRatio"] = number(camera.aspect);
  } else {
    // In double precision, so that xmag / ymag restores the aspect ratio exactly.
    const double aspect = camera.aspect > 0 ? static_cast<double>(camera.aspect) : 1;
    projection["ymag"] = static_cast<double>(camera.ymag);
    projection["xmag"] = aspect * static_cast<double>(camera.ymag);
  }
  export_camera_extension(out, camera, to);
  return to;
}

// The intensity for readers without ETENDUE_transport: area lights become point lights of the same power, ambient light
// is omitted.
float punctual_intensity(const Light& light) {
  if (light.info().description.punctual) return light.intensity();
  const float color = luminance(light.color);
  return color > 0 ? luminance(light.flux()) / (4 * kPi * color) : 0;
}

Json light_of(OutputFile& out, const Light& light, const std::filesystem::path& folder) {
  const auto value = [&](const char* parameter) {
    const auto v = light.parameter(parameter);
    return v ? std::optional(static_cast<float>(std::get<double>(*v))) : std::nullopt;
  };
  Json to{{"type", light.info().description.punctual ? light.info().description.name : "point"}};
  put_name(to, light.name);
  if (light.color != Rgb(1)) to["color"] = vector(light.color);
  put(to, "intensity", punctual_intensity(light), 1);
  if (value("range").value_or(0) > 0) to["range"] = number(*value("range"));
  if (const auto inner = value("inner-cone"), outer = value("outer-cone"); inner && outer)
    to["spot"] = {{"innerConeAngle", number(*inner)}, {"outerConeAngle", number(*outer)}};
  export_light_extension(out, light, folder, to);
  return to;
}

void put_transform(Json& to, const Transform& t) {
  if (t.matrix) {
    to["matrix"] = numbers(std::span(&(*t.matrix)[0][0], 16));
    return;
  }
  if (t.translation != Vec3(0)) to["translation"] = vector(t.translation);
  if (t.rotation != Vec4(0, 0, 0, 1)) to["rotation"] = vector(t.rotation);
  if (t.scale != Vec3(1)) to["scale"] = vector(t.scale);
}

Json node_of(OutputFile& out, const Node& node) {
  Json to = Json::object();
  put_name(to, node.name);
  put_transform(to, node.transform);
  if (!node.children.empty()) to["children"] = node.children;
  const int mesh = node.mesh >= 0 ? out.mesh_indices[static_cast<size_t>(node.mesh)] : -1;
  if (mesh >= 0) to["mesh"] = mesh;
  if (mesh >= 0 && node.skin >= 0) to["skin"] = node.skin;
  if (mesh >= 0 && !node.weights.empty()) to["weights"] = numbers(node.weights);
  if (node.camera >= 0) to["camera"] = node.camera;
  if (node.light >= 0) out.extend(to, "KHR_lights_punctual")["light"] = node.light;
  if (!node.visible) out.extend(to, "KHR_node_visibility")["visible"] = false;
  if (node.portal != Vec2(0))
    out.extend(to, kTransport)["portal"] = {{"width", number(node.portal.x)}, {"height", number(node.portal.y)}};
  return to;
}

}  // namespace

void export_cameras_and_lights(OutputFile& out, const std::filesystem::path& folder) {
  for (const Camera& camera : out.scene.cameras) out.add("cameras", camera_of(out, camera));
  if (out.scene.lights.empty()) return;
  Json& lights = out.extend(out.root, "KHR_lights_punctual")["lights"];
  for (const Light& light : out.scene.lights) lights.push_back(light_of(out, light, folder));
}

void export_nodes(OutputFile& out) {
  for (const Node& node : out.scene.nodes) out.add("nodes", node_of(out, node));
  Json scene = Json::object();
  put_name(scene, out.scene.name);
  if (!out.scene.roots.empty()) scene["nodes"] = out.scene.roots;
  out.add("scenes", std::move(scene));
  out.root["scene"] = 0;
}

}  // namespace etendue::scene::gltf
