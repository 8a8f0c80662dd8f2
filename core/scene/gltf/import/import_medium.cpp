// Imports participating media: KHR_materials_volume_scatter and the members `medium` and `atmosphere` of
// ETENDUE_transport.                                                          docs/ETENDUE_transport.schema.json
//
// Members that are out of range are ignored with a warning.
#include <algorithm>
#include <cmath>

#include "scene/gltf/import/importers.h"
#include "scene/gltf/import/uri.h"
#include "scene/gltf/transport_extension.h"

namespace etendue::scene::gltf {
namespace {

constexpr float kLargestCoefficient = 1e6f;  // 1/m

// A density of this name with these parameters; those that are invalid are reported. Paths are relative to `folder`.
template <class Warn>
DensityRef read_density(const tinygltf::Value& from, const std::filesystem::path& folder, Warn&& warn) {
  const std::string name = from.IsObject() && from.Get("name").IsString() ? from.Get("name").Get<std::string>() : "";
  DensityRef density{make_density(name)};
  if (!density) {
    warn("density.name: there is no density '" + name.substr(0, 40) + "'; the medium is homogeneous");
    return density;
  }
  const auto& parameters = from.Get("parameters");
  if (!parameters.IsObject()) return density;
  for (const std::string& key : parameters.Keys()) {
    Value value = value_of(parameters.Get(key));
    if (std::string* text = std::get_if<std::string>(&value); text && key == "file" && !text->empty()) {
      const auto file = file_of_uri(folder, *text);
      if (file) *text = file->lexically_normal().string();
    }
    const auto changed = make_density(name, {{key, value}});
    if (changed)
      density.field = density->with(key, *checked_value(*find_parameter(density->info().parameters, key), value));
    else
      warn("density.parameters." + key.substr(0, 40) + ": " + changed.error().message + "; it is ignored");
  }
  return density;
}

class MediumReader {
 public:
  MediumReader(const tinygltf::Value& from, std::string where, std::vector<std::string>& warnings)
      : from_(from), where_(std::move(where)), warnings_(warnings) {}

  // Spectra, emission and density; `folder` is the base of relative paths.
  void read_volume(const std::filesystem::path& folder, MediumDescription& medium) {
    read_spectrum("scatteringSpectrum", Coefficient::scattering, folder, medium);
    read_spectrum("absorptionSpectrum", Coefficient::absorption, folder, medium);
    medium.emission = coefficient("emission");
    medium.temperature = number("temperature", 0, 0, 40000);
    if (from_.Has("density"))
      medium.density = read_density(from_.Get("density"), folder, [&](const std::string& what) { warn(what); });
    if (!from_.Has("transmittance")) return;
    const auto& name = from_.Get("transmittance");
    for (size_t i = 0; i < Options<TransmittanceEstimator>::kOptions.size(); ++i)
      if (name.IsString() && name.Get<std::string>() == Options<TransmittanceEstimator>::kOptions[i].name) {
        medium.estimator = static_cast<TransmittanceEstimator>(i);
        return;
      }
    warn("transmittance: has to be delta, ratio, residual-ratio or regular; it is ignored");
  }

  MediumDescription run() {
    MediumDescription medium;
    medium.scattering = coefficient("scattering");
    medium.absorption = coefficient("absorption");
    if (from_.Has("phaseFunction")) medium.phase = phase_function();
    return medium;
  }

  // The member if it lies in the range; `fallback` if it is missing or invalid.
  float number(const char* member, float fallback, float low, float high) {
    return from_.Has(member) ? number_in_range(from_, member, low, high, where_, warnings_).value_or(fallback)
                             : fallback;
  }

 private:
  void warn(const std::string& what) { warnings_.push_back(where_ + "." + what); }

  Rgb coefficient(const char* member) {
    if (!from_.Has(member)) return Rgb(0);
    const Rgb c = color_or(from_, member, Rgb(-1));
    const auto valid = [](float x) { return x >= 0 && x <= kLargestCoefficient; };
    if (valid(c.r) && valid(c.g) && valid(c.b)) return c;
    warn(std::string(member) + ": has to be three numbers from 0 to 1e6; 0 is used");
    return Rgb(0);
  }

  // The spectrum of a coefficient replaces the RGB coefficient.
  void read_spectrum(const char* member, Coefficient coefficient, const std::filesystem::path& folder,
                     MediumDescription& medium) {
    if (!from_.Has(member)) return;
    std::string name = from_.Get(member).IsString() ? from_.Get(member).Get<std::string>() : "";
    if (names_coefficient_file(name)) {
      const auto file = file_of_uri(folder, name);
      if (!file) return warn(std::string(member) + ": '" + shown_uri(name) + "' is not a local file; it is ignored");
      name = file->lexically_normal().string();
    }
    const auto spectrum = find_coefficient_spectrum(coefficient, name);
    if (!spectrum) return warn(std::string(member) + ": " + spectrum.error().message + "; it is ignored");
    medium.set_spectrum(coefficient, *spectrum);
  }

  PhaseFunctionRef phase_function() {
    const auto& from = from_.Get("phaseFunction");
    const std::string name = from.IsObject() && from.Get("name").IsString() ? from.Get("name").Get<std::string>() : "";
    PhaseFunctionRef phase{make_phase_function(name)};
    if (!phase.function) {
      warn("phaseFunction.name: there is no phase function '" + name.substr(0, 40) + "'; scattering is isotropic");
      return phase;
    }
    const auto& parameters = from.Get("parameters");
    if (!parameters.IsObject()) return phase;
    for (const std::string& key : parameters.Keys()) {
      auto changed = make_phase_function(name, {{key, value_of(parameters.Get(key))}});
      if (changed)
        phase.function = phase->with(
            key, *checked_value(*find_parameter(phase->info().parameters, key), value_of(parameters.Get(key))));
      else
        warn("phaseFunction.parameters." + key.substr(0, 40) + ": " + changed.error().message + "; it is ignored");
    }
    return phase;
  }

  const tinygltf::Value& from_;
  std::string where_;
  std::vector<std::string>& warnings_;
};

// The single-scattering albedo of a medium whose thick layer has this colour.               [Kulla and Conty 2017]
float single_scattering_albedo(float color) {
  const float s = 4.09712f + 4.20863f * color - std::sqrt(9.59217f + color * (41.6808f + 17.7126f * color));
  return std::clamp(1 - s * s, 0.0f, 1.0f);
}

}  // namespace

// The attenuation becomes the extinction coefficient. Colours are bounded below, so that it stays finite.
void import_volume_scatter(const tinygltf::ExtensionMap& extensions, const std::string& where, Material& material,
                           std::vector<std::string>& warnings) {
  const auto* extension = find_extension(extensions, "KHR_materials_volume_scatter");
  if (!extension) return;
  const std::string place = where + ".extensions.KHR_materials_volume_scatter";
  const char* member = extension->Has("multiscatterColor") ? "multiscatterColor" : "multiscatterColorFactor";
  const Rgb color = color_or(*extension, member, Rgb(0));
  MediumReader reader(*extension, place, warnings);
  const float g = reader.number("scatterAnisotropy", 0, -1, 1);
  if (extension->Has("multiscatterColorTexture"))
    warnings.push_back(place + ".multiscatterColorTexture: is not supported, because the medium is homogeneous");
  constexpr float kDarkest = 1e-4f;
  MediumDescription medium;
  for (int c = 0; c < 3; ++c) {
    if (!(color[c] >= 0 && color[c] <= 1)) {
      warnings.push_back(place + "." + member + ": has to be three numbers from 0 to 1; it is ignored");
      return;
    }
    if (!std::isfinite(material.attenuation_distance)) continue;
    const float extinction =
        std::min(-std::log(std::max(material.attenuation_color[c], kDarkest)) / material.attenuation_distance,
                 kLargestCoefficient);
    medium.scattering[c] = extinction * single_scattering_albedo(color[c]);
    medium.absorption[c] = extinction - medium.scattering[c];
  }
  if (is_black(medium.scattering)) return;
  if (g != 0) medium.phase.function = make_phase_function("henyey-greenstein")->with("g", double{g});
  material.medium = medium;
  material.attenuation_color = Rgb(1);
  material.attenuation_distance = kInfinity;
}

void import_medium(const InputFile& input, const tinygltf::ExtensionMap& extensions, const std::string& where,
                   Material& material, std::vector<std::string>& warnings) {
  const auto* extension = find_extension(extensions, kTransport);
  if (!extension || !extension->Get("medium").IsObject()) return;
  const auto& from = extension->Get("medium");
  MediumReader reader(from, where + ".extensions." + kTransport + ".medium", warnings);
  material.medium = reader.run();
  reader.read_volume(input.folder, material.medium);
  material.boundary_only = from.Get("boundaryOnly").IsBool() && from.Get("boundaryOnly").Get<bool>();
  material.medium_priority = static_cast<int>(std::lround(reader.number("priority", 0, -1000, 1000)));
}

Atmosphere import_atmosphere(const InputFile& input, const tinygltf::Value& extension, const std::string& where,
                             std::vector<std::string>& warnings) {
  MediumReader reader(extension, where, warnings);
  Atmosphere atmosphere{reader.run(), kInfinity};
  reader.read_volume(input.folder, atmosphere.medium);
  atmosphere.radius = reader.number("radius", kInfinity, 1e-6f, 1e9f);
  return atmosphere;
}

}  // namespace etendue::scene::gltf
