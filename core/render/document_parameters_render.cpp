// Section "render": integrator, sampler, adaptive sampling, seed and limits. Section "auto": the automatic choice of the
// integrator.
#include "integrator/integrator.h"
#include "render/document_parameters.h"
#include "render/incompatibility.h"

namespace etendue::render {
namespace {

// A choice among the entries of a registry.
template <class Infos>
DocumentParameter registry_choice(const char* name, const char* label, const char* doc, const Infos& infos,
                                  const std::string& value, std::string MethodSettings::*member) {
  DocumentParameter parameter;
  parameter.section = "render";
  parameter.info.name = name;
  parameter.info.label = label;
  parameter.info.doc = doc;
  parameter.info.type = ParameterType::choice;
  for (const auto& info : infos) {
    parameter.info.options.push_back(info.name);
    parameter.info.option_labels.push_back(info.label);
  }
  parameter.info.default_value = value;
  parameter.assign = [member](Document& document, const Value& v) {
    document.method.*member = std::get<std::string>(v);
  };
  return parameter;
}

// The integrators of the registry, and their automatic choice.
DocumentParameter integrator_choice(const Document& document) {
  DocumentParameter parameter = registry_choice(
      "render.integrator", "Integrator", "Light transport algorithm. Automatic: short pilot renderings decide",
      integrator::integrator_infos(), document.method.integrator, &MethodSettings::integrator);
  parameter.info.options.emplace_back(kAutomatic);
  parameter.info.option_labels.emplace_back("Automatic");
  if (document.automatic.enabled) parameter.info.default_value = std::string(kAutomatic);
  parameter.assign = [](Document& d, const Value& v) {
    const auto& name = std::get<std::string>(v);
    const bool enabled = name == kAutomatic;
    if (!enabled) d.method.integrator = name;
    if (enabled == d.automatic.enabled) return;
    d.automatic.enabled = enabled;
    d.automatic.reason.clear();
  };
  return parameter;
}

DocumentParameter adaptive_choice(const MethodSettings& method) {
  DocumentParameter parameter = make_parameter(
      "render",
      Choice<Adaptive>{"adaptive", "Adaptive sampling", method.adaptive,
                       "Distributes half of the samples by estimated variance, without bias. Sample counts are then "
                       "averages over the image"},
      [](Document& d, Adaptive v) { d.method.adaptive = v; });
  parameter.inactive_reason = adaptive_incompatibility(method.integrator);
  return parameter;
}

void add_limits(DocumentParameters& list, const Limits& limits) {
  list.push_back(make_parameter("render",
                                Number<int>{"samples",
                                            "Sample limit",
                                            static_cast<int>(limits.samples),
                                            {0, 1'000'000},
                                            "Stops after this number of samples per pixel; 0: no limit",
                                            "spp",
                                            Scale::logarithmic},
                                [](Document& d, int v) { d.limits.samples = static_cast<uint32_t>(v); }));
  list.push_back(make_parameter("render",
                                Number<float>{"seconds",
                                              "Time limit",
                                              static_cast<float>(limits.seconds),
                                              {0, 1e6f},
                                              "Stops after this rendering time; 0: no limit",
                                              "s",
                                              Scale::logarithmic},
                                [](Document& d, float v) { d.limits.seconds = static_cast<double>(v); }));
  list.push_back(make_parameter("render",
                                Number<float>{"error",
                                              "Error limit",
                                              static_cast<float>(limits.error),
                                              {0, 1e6f},
                                              "Stops when the estimated error falls below this; 0: no limit. Relative "
                                              "and displayed errors are fractions: 0.01 is 1 %",
                                              limits.measure == film::ErrorMeasure::rmse ? "" : "fraction",
                                              Scale::logarithmic},
                                [](Document& d, float v) { d.limits.error = static_cast<double>(v); }));
  list.push_back(make_parameter(
      "render",
      Choice<film::ErrorMeasure>{"error-measure", "Error measure", limits.measure,
                                 "Measure of the error limit, the status bar and recommendations. RMSE: in the unit of "
                                 "the image. Relative: relative to the true value. Displayed: after exposure, tone "
                                 "mapping and sRGB encoding"},
      [](Document& d, film::ErrorMeasure v) { d.limits.measure = v; }));
}

}  // namespace

DocumentParameters render_parameters(const Document& document) {
  const MethodSettings& method = document.method;
  constexpr int kLargestSeed = 2'000'000'000;
  DocumentParameters list;
  list.push_back(integrator_choice(document));
  list.push_back(registry_choice("render.sampler", "Sampler", "Source of the sample points", sampler_infos(),
                                 method.sampler, &MethodSettings::sampler));
  list.push_back(adaptive_choice(method));
  list.push_back(make_parameter(
      "render",
      Choice<transport::ColorMode>{"color", "Colour", method.color,
                                   "RGB: three components. Spectral: four wavelengths per path, for dispersion and "
                                   "colours that depend on spectra; slower. Automatic: spectral only if a material "
                                   "disperses light"},
      [](Document& d, transport::ColorMode v) { d.method.color = v; }));
  list.push_back(make_parameter("render",
                                Number<int>{"seed",
                                            "Seed",
                                            static_cast<int>(document.seed),
                                            {0, kLargestSeed},
                                            "Seed of the random numbers; another seed gives independent noise"},
                                [](Document& d, int v) { d.seed = static_cast<uint64_t>(v); }));
  add_limits(list, document.limits);
  return list;
}

// A change of these parameters makes a new choice necessary.
DocumentParameters automatic_parameters(const Document& document) {
  const AutomaticMethod& automatic = document.automatic;
  DocumentParameters list;
  list.push_back(make_parameter(
      "auto",
      Choice<AllowedIntegrators>{
          "allow", "Allowed integrators", automatic.allow,
          "Integrators that the automatic choice may use. Unbiased: the expected image is correct at any number of "
          "samples. Consistent: it is correct in the limit of many samples. Anything: it may stay wrong"},
      [](Document& d, AllowedIntegrators v) {
        if (d.automatic.allow != v) d.automatic.reason.clear();
        d.automatic.allow = v;
      }));
  list.push_back(make_parameter(
      "auto",
      Choice<MinimisedError>{
          "error", "Error to minimise", automatic.error,
          "Measure by which the automatic choice compares integrators. RMSE: bright pixels decide. Relative: relative "
          "to the true value. Displayed: after exposure, tone mapping and sRGB encoding. FLIP: perceived difference of "
          "the displayed image"},
      [](Document& d, MinimisedError v) {
        if (d.automatic.error != v) d.automatic.reason.clear();
        d.automatic.error = v;
      }));
  if (!automatic.enabled)
    for (DocumentParameter& parameter : list)
      parameter.inactive_reason = "the integrator is not chosen automatically: set render.integrator to auto";
  return list;
}

}  // namespace etendue::render
