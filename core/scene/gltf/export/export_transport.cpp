// Exports ETENDUE_transport. Members with default values are omitted.
#include "scene/gltf/export/output_file.h"

namespace etendue::scene::gltf {
namespace {

// A relative path if the file is close to the folder, so that both can be moved together; an absolute one otherwise.
std::string uri_of(const std::filesystem::path& file, const std::filesystem::path& folder) {
  const auto absolute = std::filesystem::absolute(file).lexically_normal();
  const auto relative = absolute.lexically_relative(std::filesystem::absolute(folder).lexically_normal());
  return (relative.empty() || relative.string().starts_with("../..") ? absolute : relative).generic_string();
}

Json environment_of(OutputFile& out, const std::filesystem::path& folder) {
  const Environment& e = out.scene.environment;
  Json to = Json::object();
  if (e.map && !e.file.empty())
    to["file"] = uri_of(e.file, folder);
  else if (e.map)
    out.warnings.emplace_back("the environment map has no file; only its tint was saved");
  if (!to.empty() || e.tint != Rgb(0)) to["tint"] = vector(e.tint);
  put(to, "rotation", e.rotation, 0);
  if (!e.visible) to["visible"] = false;
  if (!to.empty() && !to.contains("tint")) to["tint"] = vector(e.tint);
  return to;
}

}  // namespace

void export_transport(OutputFile& out, const std::filesystem::path& folder) {
  Json to = Json::object();
  put(to, "time", out.scene.time, 0);
  if (out.scene.variant >= 0) to["variant"] = out.scene.variant;
  if (Json environment = environment_of(out, folder); !environment.empty()) to["environment"] = std::move(environment);
  if (!to.empty()) out.extend(out.root, kTransport) = std::move(to);
}

// Writes all parameters, because the defaults of a model may change.
void export_bsdf_model(OutputFile& out, const BsdfModelRef& model, Json& object) {
  if (!model) return;
  Json parameters = Json::object();
  for (const ParameterInfo& p : model->parameters()) {
    if (p.type == ParameterType::number)
      parameters[p.name] = number(static_cast<float>(std::get<double>(p.default_value)));
    else
      parameters[p.name] = std::visit([](const auto& value) { return Json(value); }, p.default_value);
  }
  out.extend(object, kTransport) = {{"model", model->info().description.name}, {"parameters", std::move(parameters)}};
}

void export_light_extension(OutputFile& out, const Light& light, Json& object) {
  const Light defaults;
  Json to = Json::object();
  if (light.type > LightType::directional) {
    to["type"] = kLightTypes[static_cast<size_t>(light.type)];
    to["intensity"] = number(light.intensity);
  }
  if (light.profile != defaults.profile) to["profile"] = kSpotProfiles[static_cast<size_t>(light.profile)];
  if (light.quantity != defaults.quantity) to["quantity"] = kQuantities[static_cast<size_t>(light.quantity)];
  put(to, "exponent", light.exponent, defaults.exponent);
  put(to, "width", light.width, defaults.width);
  put(to, "height", light.height, defaults.height);
  put(to, "radius", light.radius, defaults.radius);
  put(to, "focus", light.focus, defaults.focus);
  if (light.two_sided) to["twoSided"] = true;
  if (light.points > 0) to["points"] = light.points;
  if (!to.empty()) out.extend(object, kTransport) = std::move(to);
}

void export_camera_extension(OutputFile& out, const Camera& camera, Json& object) {
  const Camera defaults;
  Json to = Json::object();
  put(to, "lensRadius", camera.lens_radius, defaults.lens_radius);
  put(to, "focusDistance", camera.focus_distance, defaults.focus_distance);
  put(to, "shutter", camera.shutter, defaults.shutter);
  // An orthographic camera of glTF always has an aspect ratio.
  if (camera.projection == Projection::orthographic && !(camera.aspect > 0)) to["anyAspect"] = true;
  if (!to.empty()) out.extend(object, kTransport) = std::move(to);
}

}  // namespace etendue::scene::gltf
