// Imports ETENDUE_transport.                                                 docs/ETENDUE_transport.schema.json
//
// Members that are out of range are ignored with a warning.
#include <algorithm>
#include <cctype>
#include <limits>

#include "light/environments/sky.h"
#include "scene/coordinate_range.h"
#include "scene/environment_file.h"
#include "scene/gltf/import/importers.h"
#include "scene/gltf/import/uri.h"
#include "scene/gltf/transport_extension.h"
#include "scene/variants.h"
#include "spectrum/spectrum_names.h"

namespace etendue::scene::gltf {
namespace {

class TransportReader {
 public:
  TransportReader(const tinygltf::Value& extension, std::string where, std::vector<std::string>& warnings)
      : extension_(extension), where_(std::move(where)), warnings_(warnings) {}

  void warn(const std::string& what) { warnings_.push_back(where_ + "." + what); }

  // The member if it is in [low, high]; `fallback` otherwise, with a warning unless the member is missing.
  float number(const char* member, float fallback, float low, float high = std::numeric_limits<float>::max()) {
    if (!extension_.Has(member)) return fallback;
    return number_in_range(extension_, member, low, high, where_, warnings_).value_or(fallback);
  }
  bool flag(const char* member, bool fallback) {
    const auto& value = extension_.Get(member);
    return value.IsBool() ? value.Get<bool>() : fallback;
  }
  Rgb color(const char* member, const Rgb& fallback) {
    const auto& value = extension_.Get(member);
    if (value.Type() == tinygltf::NULL_TYPE) return fallback;
    const Rgb c = color_or(extension_, member, Rgb(-1));
    if (is_finite(c) && c.r >= 0 && c.g >= 0 && c.b >= 0) return c;
    warn(std::string(member) + ": has to be three numbers that are not negative; it is ignored");
    return fallback;
  }
  std::string text(const char* member) {
    const auto& value = extension_.Get(member);
    return value.IsString() ? value.Get<std::string>() : "";
  }

 private:
  const tinygltf::Value& extension_;
  std::string where_;
  std::vector<std::string>& warnings_;
};

Sky read_sky(TransportReader& reader, const Sky& defaults) {
  Sky sky = defaults;
  sky.sun_elevation = reader.number("sunElevation", defaults.sun_elevation, 0, kPi / 2);
  sky.sun_azimuth = reader.number("sunAzimuth", defaults.sun_azimuth, -2 * kPi, 2 * kPi);
  sky.latitude = reader.number("latitude", defaults.latitude, -kPi / 2, kPi / 2);
  sky.day = static_cast<int>(reader.number("dayOfYear", static_cast<float>(defaults.day), 1, 365));
  sky.hour = reader.number("solarHour", defaults.hour, 0, 24);
  if (reader.flag("sunByTime", false)) sky.sun_position = SunPosition::time;
  sky.turbidity = reader.number("turbidity", defaults.turbidity, least_turbidity(sky.model), kLargestTurbidity);
  sky.ground_albedo = reader.number("groundAlbedo", defaults.ground_albedo, 0, 1);
  sky.sun_disk = reader.flag("sunDisk", defaults.sun_disk);
  return sky;
}

// The spectrum of an emitter that a member names; none without the member.
EmissionSpectrumRef read_spectrum_name(TransportReader& reader, const char* member,
                                       const std::filesystem::path& folder) {
  const std::string text = reader.text(member);
  if (text.empty()) return {};
  std::string name = text;
  if (names_spectrum_file(text)) {
    const auto file = file_of_uri(folder, text);
    if (!file) {
      reader.warn(std::string(member) + ": '" + shown_uri(text) + "' is not a local file; it is ignored");
      return {};
    }
    name = file->lexically_normal().string();
  }
  const auto spectrum = find_emission_spectrum(name);
  if (spectrum) return *spectrum;
  reader.warn(std::string(member) + ": " + spectrum.error().message + "; it is ignored");
  return {};
}

Environment read_environment(const InputFile& input, TransportReader reader) {
  constexpr float kLowest = std::numeric_limits<float>::lowest();
  Environment environment;
  environment.tint = reader.color("tint", Rgb(1));
  environment.rotation = reader.number("rotation", 0, kLowest);
  environment.visible = reader.flag("visible", true);
  environment.backdrop = reader.flag("backdrop", false);
  environment.backdrop_brightness = reader.number("backdropBrightness", 1, 0);
  environment.spectrum = read_spectrum_name(reader, "spectrum", input.folder);
  if (const std::string preset = reader.text("preset"); !preset.empty()) {
    if (const BuiltinEnvironment* builtin = find_builtin_environment(preset)) {
      Environment made = make_environment(*builtin);
      if (made.sky) made = make_sky(read_sky(reader, *made.sky));
      made.tint = environment.tint;
      made.keep_settings_of(environment);
      environment = std::move(made);
    } else {
      reader.warn("preset: there is no environment '" + preset + "'; the tint alone lights the scene");
    }
    return environment;
  }
  const std::string uri = reader.text("file");
  if (uri.empty()) return environment;
  const auto file = file_of_uri(input.folder, uri);
  auto map = file ? load_environment_map(*file) : input_error("'" + shown_uri(uri) + "' is not a local file");
  if (map) {
    environment.map = *map;
    environment.file = file->lexically_normal().string();
  } else {
    reader.warn("file: " + map.error().message + "; the tint alone lights the scene");
  }
  return environment;
}

// Sets a parameter that is the path of a file to the file that the member names.
void read_file_parameter(TransportReader& reader, const ParameterInfo& info, const std::filesystem::path& folder,
                         Light& light) {
  const std::string member = member_name(info.name);
  const std::string uri = reader.text(member.c_str());
  const auto file = file_of_uri(folder, uri);
  const std::string path = file ? file->lexically_normal().string() : "";
  const Result<void> accepted =
      file ? info.validate_text(path) : input_error("'" + shown_uri(uri) + "' is not a local file");
  if (accepted)
    light.set(info.name, path);
  else
    reader.warn(member + ": " + accepted.error().message + "; it is ignored");
}

// Sets a light's parameter to the member of its name, where there is one.
void read_parameter(const tinygltf::Value& extension, TransportReader& reader, const ParameterInfo& info,
                    const std::filesystem::path& folder, Light& light) {
  const std::string member = member_name(info.name);
  if (!extension.Has(member)) return;
  if (info.type == ParameterType::toggle) {
    light.set(info.name, reader.flag(member.c_str(), std::get<bool>(info.default_value)));
  } else if (info.type == ParameterType::number) {
    const auto fallback = static_cast<float>(std::get<double>(info.default_value));
    const float max = info.unit == "m" ? kMaxCoordinate : std::numeric_limits<float>::max();
    light.set(info.name, double{reader.number(member.c_str(), fallback, static_cast<float>(info.min), max)});
  } else if (info.type == ParameterType::integer) {
    const int fallback = static_cast<int>(std::get<int64_t>(info.default_value));
    const int value = index_or(extension, member.c_str(), fallback);
    light.set(info.name, int64_t{std::clamp(value, static_cast<int>(info.min), static_cast<int>(info.max))});
  } else if (const std::string name = reader.text(member.c_str()); std::ranges::count(info.options, name) > 0) {
    light.set(info.name, name);
  } else if (info.validate_text) {
    read_file_parameter(reader, info, folder, light);
  } else {
    reader.warn(member + ": '" + name.substr(0, 40) + "' is not an allowed value; it is ignored");
  }
}

}  // namespace

Value value_of(const tinygltf::Value& value) {
  if (value.IsBool()) return value.Get<bool>();
  if (value.IsInt()) return int64_t{value.GetNumberAsInt()};
  // Parameters are floats, and so are the limits of their ranges.
  if (value.IsNumber()) return double{static_cast<float>(value.GetNumberAsDouble())};
  return value.IsString() ? value.Get<std::string>() : std::string();
}

BsdfModelRef import_bsdf_model(const tinygltf::ExtensionMap& extensions, const std::string& where,
                               std::vector<std::string>& warnings) {
  const auto* extension = find_extension(extensions, kTransport);
  if (!extension || !extension->Has("model")) return {};
  TransportReader reader(*extension, where + ".extensions." + kTransport, warnings);
  const std::string name = reader.text("model");
  BsdfModelRef model{make_bsdf_model(name)};
  if (!model) {
    reader.warn("model: there is no reflection model '" + name.substr(0, 40) + "'; the glTF material is used");
    return model;
  }
  const auto& parameters = extension->Get("parameters");
  if (!parameters.IsObject()) return model;
  const auto known = model->info().parameters;
  for (const std::string& key : parameters.Keys()) {
    const ParameterInfo* info = find_parameter(known, key);
    const auto value = info ? checked_value(*info, value_of(parameters.Get(key)))
                            : Result<Value>(usage_error("the model '" + name + "' has no such parameter"));
    if (value)
      model.model = model->with(key, *value);
    else
      reader.warn("parameters." + key.substr(0, 40) + ": " + value.error().message + "; it is ignored");
  }
  return model;
}

Layering import_layering(const tinygltf::ExtensionMap& extensions, const std::string& where,
                         std::vector<std::string>& warnings) {
  const auto* extension = find_extension(extensions, kTransport);
  if (!extension || !extension->Has("layering")) return Layering::gltf;
  TransportReader reader(*extension, where + ".extensions." + kTransport, warnings);
  const std::string name = reader.text("layering");
  if (name == kEnergyConserving) return Layering::energy_conserving;
  if (name != "gltf")
    reader.warn("layering: '" + name.substr(0, 40) + "' is not an allowed value; the layering of glTF is used");
  return Layering::gltf;
}

Glass import_glass(const tinygltf::ExtensionMap& extensions, const std::string& where,
                   std::vector<std::string>& warnings) {
  const auto* extension = find_extension(extensions, kTransport);
  if (!extension || !extension->Has("glass")) return Glass::none;
  TransportReader reader(*extension, where + ".extensions." + kTransport, warnings);
  const std::string name = reader.text("glass");
  for (const SellmeierFormula& formula : sellmeier_formulas())
    if (name == formula.name) return formula.glass;
  reader.warn("glass: '" + name.substr(0, 40) + "' is not an allowed value; ior and dispersion are used");
  return Glass::none;
}

EmissionSpectrumRef import_emission_spectrum(const InputFile& input, const tinygltf::ExtensionMap& extensions,
                                             const std::string& where, std::vector<std::string>& warnings) {
  const auto* extension = find_extension(extensions, kTransport);
  if (!extension) return {};
  TransportReader reader(*extension, where + ".extensions." + kTransport, warnings);
  return read_spectrum_name(reader, "emissionSpectrum", input.folder);
}

std::string member_name(std::string_view parameter) {
  std::string name;
  for (const char c : parameter) {
    if (!name.empty() && name.back() == '-')
      name.back() = static_cast<char>(std::toupper(c));
    else
      name += c;
  }
  return name;
}

void import_light_extension(const InputFile& input, const tinygltf::ExtensionMap& extensions, const std::string& where,
                            Light& light, std::vector<std::string>& warnings) {
  const auto* extension = find_extension(extensions, kTransport);
  if (!extension) return;
  TransportReader reader(*extension, where + ".extensions." + kTransport, warnings);
  if (const std::string name = reader.text("type"); !name.empty() && name != light.info().description.name) {
    if (find_light_type(name)) {
      Light typed = make_light(name, {{"intensity", double{light.intensity()}}});
      typed.name = light.name;
      typed.color = light.color;
      light = std::move(typed);
    } else {
      reader.warn("type: '" + name.substr(0, 40) + "' is not an allowed value; it is ignored");
    }
  }
  for (const ParameterInfo& info : light.model->parameters())
    read_parameter(*extension, reader, info, input.folder, light);
  light.spectrum = read_spectrum_name(reader, "spectrum", input.folder);
}

Vec2 import_portal(const tinygltf::ExtensionMap& extensions, const std::string& where,
                   std::vector<std::string>& warnings) {
  const auto* extension = find_extension(extensions, kTransport);
  if (!extension || !extension->Get("portal").IsObject()) return Vec2(0);
  TransportReader reader(extension->Get("portal"), where + ".extensions." + kTransport + ".portal", warnings);
  return {reader.number("width", 0, 0, kMaxCoordinate), reader.number("height", 0, 0, kMaxCoordinate)};
}

void import_transport(const InputFile& input, Scene& scene) {
  const auto* extension = find_extension(input.model.extensions, kTransport);
  if (!extension) return;
  const std::string where = std::string("extensions.") + kTransport;
  scene.time = TransportReader(*extension, where, scene.warnings).number("time", 0, 0);
  const int variant = index_or(*extension, "variant", -1);
  if (variant >= 0)
    select_variant(scene, static_cast<int>(checked_index(variant, scene.variants.size(), where, "variants")));
  if (extension->Get("environment").IsObject())
    scene.environment =
        read_environment(input, TransportReader(extension->Get("environment"), where + ".environment", scene.warnings));
  if (extension->Get("atmosphere").IsObject())
    scene.atmosphere = import_atmosphere(input, extension->Get("atmosphere"), where + ".atmosphere", scene.warnings);
}

void import_camera_extension(const tinygltf::ExtensionMap& extensions, const std::string& where, Camera& camera,
                             std::vector<std::string>& warnings) {
  const auto* extension = find_extension(extensions, kTransport);
  if (!extension) return;
  TransportReader reader(*extension, where + ".extensions." + kTransport, warnings);
  camera.lens_radius = reader.number("lensRadius", camera.lens_radius, 0, kMaxCoordinate);
  camera.focus_distance =
      reader.number("focusDistance", camera.focus_distance, std::numeric_limits<float>::min(), kMaxCoordinate);
  camera.shutter = reader.number("shutter", camera.shutter, 0);
  if (reader.flag("anyAspect", false)) camera.aspect = 0;
}

}  // namespace etendue::scene::gltf
