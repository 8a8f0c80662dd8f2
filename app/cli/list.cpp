// etendue list: the registries, with a description of every parameter.
#include <cstdio>
#include <functional>
#include <memory>

#include "base/number_text.h"
#include "bsdf/fresnel/metal_spectra.h"
#include "bsdf/fresnel/optical_constants.h"
#include "command.h"
#include "experiments/experiment.h"
#include "integrator/integrator.h"
#include "json.h"
#include "material/diffusion_of_medium.h"
#include "medium/coefficient_spectrum.h"
#include "medium/medium_presets.h"
#include "render/document.h"
#include "sampling/sampler.h"
#include "scene/builtin/builtin.h"
#include "scene_options.h"
#include "section_infos.h"
#include "spectrum/refractive_index.h"
#include "spectrum/spectrum_names.h"
#include "viewer/viewer.h"

namespace etendue::cli {
namespace {

json parameter_json(const ParameterInfo& p) {
  const bool is_number = p.type == ParameterType::integer || p.type == ParameterType::number;
  json j{{"name", p.name},
         {"label", p.label},
         {"type", type_name(p.type)},
         {"unit", p.unit},
         {"min", is_number ? json(p.min) : json()},
         {"max", is_number ? json(p.max) : json()},
         {"default", to_json_value<json>(p.default_value)},
         {"doc", p.doc}};
  if (p.type == ParameterType::choice) j["options"] = p.options;
  return j;
}

json entry_json(const std::string& name, const std::string& label, const std::string& doc,
                const std::vector<ParameterInfo>& parameters) {
  json list = json::array();
  for (const auto& p : parameters) list.push_back(parameter_json(p));
  return {{"name", name}, {"label", label}, {"doc", doc}, {"parameters", list}};
}

json integrators_json() {
  json list = json::array();
  for (const auto& info : integrator::integrator_infos()) {
    json j = entry_json(info.name, info.label, info.summary, info.parameters);
    j["group"] = integrator::info_of(info.group).name;
    j["key"] = info.shortcut ? json(std::string(1, info.shortcut)) : json();
    j["paths"] = info.paths;
    j["point_paths"] = info.point_paths;
    j["bias"] = integrator::bias_name(info.bias);
    j["cost"] = info.cost;
    j["fails"] = info.limitations;
    j["division"] = {{"unit", integrator::division_name(info.division.unit)},
                     {"regions", info.division.regions},
                     {"reason", info.division.reason}};
    list.push_back(j);
  }
  return list;
}

json samplers_json() {
  json list = json::array();
  for (const auto& info : sampler_infos()) {
    json j = entry_json(info.name, info.label, info.doc, info.parameters);
    j["progressive"] = info.progressive;
    j["independent"] = info.independent;
    j["joint_dimensions"] = info.joint_dimensions;
    j["padding"] = info.padding;
    list.push_back(j);
  }
  return list;
}

json presets_json(const std::vector<ModelPreset>& presets) {
  json list = json::array();
  for (const auto& p : presets) {
    json values = json::object();
    for (const auto& [name, value] : p.values) values[name] = to_json_value<json>(value);
    list.push_back({{"name", p.name}, {"label", p.label}, {"source", p.source}, {"values", values}});
  }
  return list;
}

json materials_json() {
  json list = json::array({entry_json(
      "gltf", "glTF surface",
      "Metallic-roughness material with transmission, volume, specular, IOR and emission [glTF 2.0, appendix B]",
      section_infos(sample_document(), "material.0"))});
  for (const auto& info : bsdf_model_infos()) {
    const BsdfModelDescription& model = info.description;
    json j = entry_json(model.name, model.label, model.summary, info.parameters);
    j["class"] = Options<ModelClass>::kOptions[static_cast<size_t>(model.model_class)].name;
    j["formula"] = model.formula;
    j["properties"] = model.properties;
    j["sampling"] = model.sampling;
    j["limitations"] = model.limitations;
    j["source"] = model.source;
    j["presets"] = presets_json(info.presets);
    list.push_back(j);
  }
  return list;
}

json lights_json() {
  json list = json::array();
  list.push_back(entry_json("area", "Emissive triangles",
                            "All triangles of a material with emission; the parameters are those of the material", {}));
  for (const LightTypeInfo& info : light_type_infos()) {
    const LightTypeDescription& type = info.description;
    json j = entry_json(type.name, type.label, type.summary, section_infos(sample_document(type.name), "light.0"));
    j["class"] = Options<LightClass>::kOptions[static_cast<size_t>(type.light_class)].name;
    j["formula"] = type.formula;
    j["sampling"] = type.sampling;
    j["source"] = type.source;
    list.push_back(j);
  }
  list.push_back(entry_json("environment", "Environment",
                            "Radiance from infinity, constant or from an equirectangular map",
                            section_infos(sample_document(), "environment")));
  return list;
}

json media_json() {
  json list = json::array({entry_json("absorbing", "Absorbing volume",
                                      "Beer's law inside solids with KHR_materials_volume; the parameters are those of "
                                      "the material",
                                      {}),
                           entry_json("atmosphere", "Atmosphere", "The medium around all solids",
                                      section_infos(sample_document(), "atmosphere"))});
  for (const MediumPreset& preset : medium_presets()) {
    const MediumDescription& m = preset.medium;
    json j = entry_json(preset.name, preset.label, preset.source, {});
    j["scattering"] = color_json(m.scattering);
    j["absorption"] = color_json(m.absorption);
    j["unit"] = "1/m";
    j["phase_function"] = m.phase->info().description.name;
    j["mean_cosine"] = number_json(m.phase->mean_cosine());
    // Of the model "dipole" with its default index of refraction.
    const DiffusionOfMedium diffusion = diffusion_of(m, 1.3f);
    j["diffusion_albedo"] = color_json(diffusion.albedo);
    j["diffusion_mean_free_path_mm"] = color_json(diffusion.mean_free_path * 1000);
    list.push_back(j);
  }
  return list;
}

json phase_functions_json() {
  json list = json::array();
  for (const PhaseFunctionInfo& info : phase_function_infos()) {
    const PhaseFunctionDescription& phase = info.description;
    json j = entry_json(phase.name, phase.label, phase.summary, info.parameters);
    j["formula"] = phase.formula;
    j["mean_cosine"] = phase.mean_cosine;
    j["sampling"] = phase.sampling;
    j["limitations"] = phase.limitations;
    j["source"] = phase.source;
    list.push_back(j);
  }
  return list;
}

json densities_json() {
  json list = json::array();
  for (const DensityInfo& info : density_infos()) {
    const DensityDescription& density = info.description;
    json j = entry_json(density.name, density.label, density.summary, info.parameters);
    j["formula"] = density.formula;
    j["limitations"] = density.limitations;
    j["source"] = density.source;
    list.push_back(j);
  }
  return list;
}

// Values every 20 nm.
json samples_json(const std::function<double(double)>& spectrum) {
  constexpr double kStep = 20;
  json samples = json::array();
  for (double wavelength = kFirstWavelength; wavelength <= kLastWavelength; wavelength += kStep)
    samples.push_back({wavelength, spectrum(wavelength)});
  return samples;
}

// Illuminants, metals, coefficients of media and glasses by wavelength in nm.
json spectra_json() {
  json list = json::array();
  for (const Illuminant& illuminant : illuminants()) {
    json j = entry_json(illuminant.name, illuminant.label, illuminant.source, {});
    j["class"] = "illuminant";
    j["power"] = samples_json(illuminant.make());
    list.push_back(j);
  }
  for (const MetalSpectrum& metal : metal_spectra())
    for (const ConductorConstants& constants : kConductors) {
      if (std::string_view(constants.name) != metal.name) continue;
      json j = entry_json(constants.name, constants.label, constants.source, {});
      j["class"] = "metal";
      j["eta"] = samples_json([&](double w) { return metal.eta(static_cast<float>(w)); });
      j["kappa"] = samples_json([&](double w) { return metal.kappa(static_cast<float>(w)); });
      list.push_back(j);
    }
  for (const NamedCoefficient& named : named_coefficients()) {
    const bool scatters = named.coefficient == Coefficient::scattering;
    json j = entry_json(named.name, named.label, named.source, {});
    j["class"] = scatters ? "scattering coefficient" : "absorption coefficient";
    const CoefficientSpectrum spectrum(named.make());
    j["per_metre"] = samples_json([&](double w) { return spectrum.at(static_cast<float>(w)); });
    list.push_back(j);
  }
  for (const SellmeierFormula& glass : sellmeier_formulas()) {
    json j = entry_json(glass.name, glass.label, glass.source, {});
    j["class"] = "glass";
    j["eta"] = samples_json([&](double w) { return glass.index(w); });
    j["eta_d"] = glass.index_d();
    j["abbe"] = 20 / glass.dispersion();
    list.push_back(j);
  }
  return list;
}

json scenes_json() {
  json list = json::array();
  for (const scene::Builtin& b : scene::builtins()) list.push_back(entry_json(b.name, b.label, b.doc, {}));
  return list;
}

json experiments_json() {
  json list = json::array();
  for (const experiments::Experiment& e : experiments::experiments()) {
    list.push_back(entry_json(e.description.name, e.description.label, e.description.summary, e.parameters));
    list.back()["source"] = e.description.source;
  }
  return list;
}

json widgets_json() { return json::parse(viewer::widgets_json()); }

struct Registry {
  const char* name;
  json (*make)();
};
constexpr Registry kRegistries[] = {
    {"integrators", integrators_json}, {"samplers", samplers_json}, {"materials", materials_json},
    {"lights", lights_json},           {"media", media_json},       {"phase-functions", phase_functions_json},
    {"densities", densities_json},     {"spectra", spectra_json},   {"scenes", scenes_json},
    {"experiments", experiments_json}, {"widgets", widgets_json}};

std::string registry_names() {
  std::string names;
  for (const auto& registry : kRegistries) names += (names.empty() ? "" : ", ") + std::string(registry.name);
  return names;
}

// A value without quotation marks. Six digits are enough for the parameters, which are single-precision numbers.
std::string plain_text(const json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) return format_number(value.get<double>(), 6);
  if (!value.is_array()) return value.dump();
  std::string text;
  for (const auto& element : value) text += (text.empty() ? "" : " ") + plain_text(element);
  return text;
}

void print_parameter(const json& p) {
  std::string range;
  if (!p["min"].is_null()) range = plain_text(p["min"]) + " to " + plain_text(p["max"]);
  if (p.contains("options"))
    for (const auto& option : p["options"]) range += (range.empty() ? "" : ", ") + plain_text(option);
  if (range.empty()) range = "true, false";
  const std::string unit = plain_text(p["unit"]);
  std::printf("    %-22s %s [%s] default %s%s\n", plain_text(p["name"]).c_str(), plain_text(p["doc"]).c_str(),
              range.c_str(), plain_text(p["default"]).c_str(), unit.empty() ? "" : (" " + unit).c_str());
}

void print_entries(const json& list) {
  for (const auto& e : list) {
    std::printf("%s: %s\n  %s\n", plain_text(e["name"]).c_str(), plain_text(e["label"]).c_str(),
                plain_text(e["doc"]).c_str());
    if (e.contains("paths"))
      std::printf("  %s; paths %s, %s\n  limitations: %s\n", plain_text(e["group"]).c_str(),
                  plain_text(e["paths"]).c_str(), plain_text(e["bias"]).c_str(), plain_text(e["fails"]).c_str());
    if (e.contains("scattering"))
      std::printf("  scattering %s, absorption %s 1/m; %s, mean cosine %s\n", plain_text(e["scattering"]).c_str(),
                  plain_text(e["absorption"]).c_str(), plain_text(e["phase_function"]).c_str(),
                  plain_text(e["mean_cosine"]).c_str());
    if (e.contains("abbe"))
      std::printf("  index of refraction %.5f at 587.56 nm, Abbe number %.2f\n", e["eta_d"].get<double>(),
                  e["abbe"].get<double>());
    for (const auto& p : e["parameters"]) print_parameter(p);
  }
}

}  // namespace

Command list_command() {
  struct ListArguments {
    std::string kind;
    bool json = false;
  };
  const auto a = std::make_shared<ListArguments>();
  return {.name = "list",
          .summary = "List integrators, samplers and other registries with their parameters",
          .options = {{.names = "kind", .target = &a->kind, .doc = "One of " + registry_names(), .required = true},
                      json_flag(a->json)},
          .run = [a] {
            for (const auto& registry : kRegistries) {
              if (a->kind != registry.name) continue;
              const json list = registry.make();
              if (a->json)
                std::printf("%s\n", list.dump(2).c_str());
              else
                print_entries(list);
              return 0;
            }
            return fail(usage_error("list: there is no registry '" + a->kind + "'; give one of " + registry_names()));
          }};
}

}  // namespace etendue::cli
