// Exports ETENDUE_transport. Members with default values are omitted.
#include <algorithm>

#include "light/environments/builtin_environment.h"
#include "scene/gltf/export/output_file.h"
#include "scene/gltf/transport_extension.h"
#include "spectrum/spectrum_names.h"

namespace etendue::scene::gltf {
namespace {

// A relative path if the file is close to the folder, so that both can be moved together; an absolute one otherwise.
std::string uri_of(const std::filesystem::path& file, const std::filesystem::path& folder) {
  const auto absolute = std::filesystem::absolute(file).lexically_normal();
  const auto relative = absolute.lexically_relative(std::filesystem::absolute(folder).lexically_normal());
  return (relative.empty() || relative.string().starts_with("../..") ? absolute : relative).generic_string();
}

void put_sky(Json& to, const Sky& sky) {
  const Sky defaults;
  put(to, "sunElevation", sky.sun_elevation, defaults.sun_elevation);
  put(to, "sunAzimuth", sky.sun_azimuth, defaults.sun_azimuth);
  if (sky.sun_position == SunPosition::time) to["sunByTime"] = true;
  put(to, "latitude", sky.latitude, defaults.latitude);
  if (sky.day != defaults.day) to["dayOfYear"] = sky.day;
  put(to, "solarHour", sky.hour, defaults.hour);
  put(to, "turbidity", sky.turbidity, defaults.turbidity);
  put(to, "groundAlbedo", sky.ground_albedo, defaults.ground_albedo);
  if (!sky.sun_disk) to["sunDisk"] = false;
}

// A spectrum by name. Files are relative to the folder.
template <class T>
void put_spectrum(Json& to, const char* member, const NamedSpectrum<T>& spectrum, bool is_file,
                  const std::filesystem::path& folder) {
  if (spectrum) to[member] = is_file ? uri_of(spectrum.name, folder) : spectrum.name;
}
void put_spectrum(Json& to, const char* member, const EmissionSpectrumRef& spectrum,
                  const std::filesystem::path& folder) {
  put_spectrum(to, member, spectrum, names_spectrum_file(spectrum.name), folder);
}
void put_spectrum(Json& to, const char* member, const CoefficientSpectrumRef& spectrum,
                  const std::filesystem::path& folder) {
  put_spectrum(to, member, spectrum, names_coefficient_file(spectrum.name), folder);
}

Json environment_of(OutputFile& out, const std::filesystem::path& folder) {
  const Environment& e = out.scene.environment;
  Json to = Json::object();
  if (e.map && find_builtin_environment(e.file))
    to["preset"] = e.file;
  else if (e.map && !e.file.empty())
    to["file"] = uri_of(e.file, folder);
  else if (e.map)
    out.warnings.emplace_back("the environment map has no file; only its tint was saved");
  if (!to.empty() || e.tint != Rgb(0)) to["tint"] = vector(e.tint);
  put(to, "rotation", e.rotation, 0);
  if (!e.visible) to["visible"] = false;
  if (e.backdrop) to["backdrop"] = true;
  put(to, "backdropBrightness", e.backdrop_brightness, 1);
  put_spectrum(to, "spectrum", e.spectrum, folder);
  if (e.sky && e.file == to.value("preset", "")) put_sky(to, *e.sky);
  if (!to.empty() && !to.contains("tint")) to["tint"] = vector(e.tint);
  return to;
}

// The value of a description whose default is the current value.
Json current_value(const ParameterInfo& p) {
  if (p.type == ParameterType::number) return number(static_cast<float>(std::get<double>(p.default_value)));
  return to_json_value<Json>(p.default_value);
}

Json density_of(const DensityRef& density, const std::filesystem::path& folder) {
  Json parameters = Json::object();
  for (const ParameterInfo& p : density->parameters()) {
    parameters[p.name] = current_value(p);
    if (const auto* path = std::get_if<std::string>(&p.default_value); path && p.name == "file" && !path->empty())
      parameters[p.name] = uri_of(*path, folder);
  }
  return {{"name", density->info().description.name}, {"parameters", std::move(parameters)}};
}

void export_volume(const MediumDescription& medium, const std::filesystem::path& folder, Json& to) {
  if (!is_black(medium.emission)) to["emission"] = vector(medium.emission);
  put(to, "temperature", medium.temperature, 0);
  if (medium.density) to["density"] = density_of(medium.density, folder);
  if (medium.estimator != MediumDescription().estimator)
    to["transmittance"] = Options<TransmittanceEstimator>::kOptions[static_cast<size_t>(medium.estimator)].name;
}

Json medium_of(const MediumDescription& medium, const std::filesystem::path& folder) {
  Json to = Json::object();
  export_volume(medium, folder, to);
  if (!is_black(medium.scattering)) to["scattering"] = vector(medium.scattering);
  if (!is_black(medium.absorption)) to["absorption"] = vector(medium.absorption);
  put_spectrum(to, "scatteringSpectrum", medium.scattering_spectrum, folder);
  put_spectrum(to, "absorptionSpectrum", medium.absorption_spectrum, folder);
  if (medium.phase == PhaseFunctionRef()) return to;
  Json parameters = Json::object();
  for (const ParameterInfo& p : medium.phase->parameters()) parameters[p.name] = current_value(p);
  to["phaseFunction"] = {{"name", medium.phase->info().description.name}, {"parameters", std::move(parameters)}};
  return to;
}

}  // namespace

void export_medium(OutputFile& out, const Material& material, Json& object) {
  Json to = medium_of(material.medium, out.folder);
  if (material.boundary_only) to["boundaryOnly"] = true;
  if (material.medium_priority != 0) to["priority"] = material.medium_priority;
  if (!to.empty()) out.extend(object, kTransport)["medium"] = std::move(to);
}

void export_transport(OutputFile& out, const std::filesystem::path& folder) {
  Json to = Json::object();
  put(to, "time", out.scene.time, 0);
  if (out.scene.variant >= 0) to["variant"] = out.scene.variant;
  if (Json environment = environment_of(out, folder); !environment.empty()) to["environment"] = std::move(environment);
  Json atmosphere = medium_of(out.scene.atmosphere.medium, folder);
  if (std::isfinite(out.scene.atmosphere.radius)) atmosphere["radius"] = number(out.scene.atmosphere.radius);
  if (!atmosphere.empty()) to["atmosphere"] = std::move(atmosphere);
  if (!to.empty()) out.extend(out.root, kTransport) = std::move(to);
}

// Writes all parameters, because the defaults of a model may change.
void export_bsdf_model(OutputFile& out, const BsdfModelRef& model, Json& object) {
  if (!model) return;
  Json parameters = Json::object();
  for (const ParameterInfo& p : model->parameters()) parameters[p.name] = current_value(p);
  out.extend(object, kTransport) = {{"model", model->info().description.name}, {"parameters", std::move(parameters)}};
}

void export_layering(OutputFile& out, Layering layering, Json& object) {
  if (layering == Layering::energy_conserving) out.extend(object, kTransport)["layering"] = kEnergyConserving;
}

void export_glass(OutputFile& out, Glass glass, Json& object) {
  if (const SellmeierFormula* formula = find_sellmeier(glass)) out.extend(object, kTransport)["glass"] = formula->name;
}

void export_emission_spectrum(OutputFile& out, const EmissionSpectrumRef& spectrum, Json& object) {
  if (spectrum) put_spectrum(out.extend(object, kTransport), "emissionSpectrum", spectrum, out.folder);
}

// Writes the type and the parameters that KHR_lights_punctual has no members for, unless they have their defaults.
void export_light_extension(OutputFile& out, const Light& light, const std::filesystem::path& folder, Json& object) {
  const LightTypeInfo& type = light.info();
  const bool punctual = type.description.punctual;
  Json to = Json::object();
  if (!punctual) to["type"] = type.description.name;
  const std::vector<ParameterInfo> values = light.model->parameters();
  for (size_t i = 0; i < values.size(); ++i) {
    const ParameterInfo& p = values[i];
    const bool is_default = p.default_value == type.parameters[i].default_value;
    const bool is_written = punctual ? !is_default && std::ranges::count(kPunctualParameters, p.name) == 0
                                     : !is_default || p.name == "intensity";
    if (!is_written) continue;
    Json& member = to[member_name(p.name)] = current_value(p);
    const bool is_file = p.validate_text && std::ranges::count(p.options, member.get<std::string>()) == 0;
    if (is_file) member = uri_of(member.get<std::string>(), folder);
  }
  put_spectrum(to, "spectrum", light.spectrum, folder);
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
