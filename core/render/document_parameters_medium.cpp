#include "render/document_parameters_medium.h"

#include <algorithm>

#include "medium/medium_presets.h"

namespace etendue::render {
namespace {

constexpr float kLargestCoefficient = 1e6f;  // 1/m

// Changes the medium in a document.
template <class F>
void edit_medium(Document& document, const MediumOwner& owner, F&& edit) {
  edit_scene(document, [&](scene::Scene& s) { edit(owner.medium(s)); });
}

DocumentParameter preset_choice(const MediumOwner& owner, const MediumDescription& medium) {
  DocumentParameter parameter = choice_parameter(
      owner.section, "medium", "Medium", "Sets the coefficients and the phase function to those of a known medium");
  parameter.info.options = {kNoMediumPreset};
  parameter.info.option_labels = {"Custom"};
  for (const MediumPreset& preset : medium_presets()) {
    parameter.info.options.push_back(preset.name);
    parameter.info.option_labels.push_back(preset.label);
  }
  parameter.info.default_value = std::string(preset_of(medium));
  parameter.assign = [owner](Document& d, const Value& v) {
    if (const MediumPreset* preset = find_medium_preset(std::get<std::string>(v)))
      edit_medium(d, owner, [&](MediumDescription& m) {
        m.scattering = preset->medium.scattering;
        m.absorption = preset->medium.absorption;
        m.scattering_spectrum = m.absorption_spectrum = {};
        m.phase = preset->medium.phase;
      });
  };
  return parameter;
}

// Editing an RGB coefficient replaces a measured one.
void add_coefficient(DocumentParameters& list, const MediumOwner& owner, const char* const (&names)[3],
                     const char* label, const Rgb& value, Rgb MediumDescription::*member,
                     CoefficientSpectrumRef MediumDescription::*spectrum, const char* doc) {
  Vec3 shown(value.r, value.g, value.b);
  shown = glm::min(shown, Vec3(kLargestCoefficient));
  add_triple(list, owner.section,
             {.names = {names[0], names[1], names[2]},
              .label = label,
              .value = shown,
              .range = {0, kLargestCoefficient},
              .doc = doc,
              .unit = "1/m"},
             [owner, member, spectrum](Document& d, int c, float v) {
               edit_medium(d, owner, [&](MediumDescription& m) {
                 (m.*member)[c] = v;
                 m.*spectrum = {};
               });
             });
}

void add_coefficient_spectrum(DocumentParameters& list, const MediumOwner& owner, Coefficient coefficient,
                              const CoefficientSpectrumRef& value) {
  list.push_back(make_parameter(owner.section, coefficient_spectrum_parameter(coefficient, value),
                                [owner, coefficient](Document& d, const std::string& name) {
                                  const auto spectrum = find_coefficient_spectrum(coefficient, name);
                                  if (!spectrum) return;
                                  edit_medium(d, owner,
                                              [&](MediumDescription& m) { m.set_spectrum(coefficient, *spectrum); });
                                }));
}

DocumentParameter phase_choice(const MediumOwner& owner, const MediumDescription& medium) {
  DocumentParameter parameter = choice_parameter(owner.section, "phase-function", "Phase function",
                                                 "Directional distribution of scattered light");
  for (const PhaseFunctionInfo& info : phase_function_infos()) {
    parameter.info.options.emplace_back(info.description.name);
    parameter.info.option_labels.emplace_back(info.description.label);
  }
  parameter.info.default_value = std::string(medium.phase->info().description.name);
  parameter.assign = [owner](Document& d, const Value& v) {
    edit_medium(d, owner,
                [&](MediumDescription& m) { m.phase.function = make_phase_function(std::get<std::string>(v)); });
  };
  return parameter;
}

void add_phase_function(DocumentParameters& list, const MediumOwner& owner, const MediumDescription& medium) {
  list.push_back(phase_choice(owner, medium));
  for (const ParameterInfo& info : medium.phase->parameters()) {
    DocumentParameter parameter;
    parameter.section = owner.section;
    parameter.info = info;
    parameter.info.name = owner.section + ".phase." + info.name;
    parameter.assign = [owner, parameter_name = info.name](Document& d, const Value& v) {
      edit_medium(d, owner, [&](MediumDescription& m) { m.phase.function = m.phase->with(parameter_name, v); });
    };
    list.push_back(std::move(parameter));
  }
}

// The choices and parameters of a density; "homogeneous" stands for none.
constexpr const char* kHomogeneous = "homogeneous";

DocumentParameter density_choice(const MediumOwner& owner, const MediumDescription& medium) {
  DocumentParameter parameter = choice_parameter(owner.section, "density", "Density",
                                                 "Factor on all coefficients that varies inside the bounding box");
  parameter.info.options = {kHomogeneous};
  parameter.info.option_labels = {"Homogeneous"};
  for (const DensityInfo& info : density_infos()) {
    parameter.info.options.emplace_back(info.description.name);
    parameter.info.option_labels.emplace_back(info.description.label);
  }
  parameter.info.default_value = std::string(medium.density ? medium.density->info().description.name : kHomogeneous);
  parameter.assign = [owner](Document& d, const Value& v) {
    edit_medium(d, owner, [&](MediumDescription& m) { m.density.field = make_density(std::get<std::string>(v)); });
  };
  return parameter;
}

void add_density(DocumentParameters& list, const MediumOwner& owner, const MediumDescription& medium) {
  list.push_back(density_choice(owner, medium));
  if (!medium.density) return;
  for (const ParameterInfo& info : medium.density->parameters()) {
    DocumentParameter parameter;
    parameter.section = owner.section;
    parameter.info = info;
    parameter.info.name = owner.section + ".density." + info.name;
    parameter.assign = [owner, parameter_name = info.name](Document& d, const Value& v) {
      edit_medium(d, owner, [&](MediumDescription& m) {
        if (m.density) m.density.field = m.density->with(parameter_name, v);
      });
    };
    list.push_back(std::move(parameter));
  }
  list.push_back(make_parameter(owner.section,
                                Choice<TransmittanceEstimator>{
                                    "medium-transmittance", "Transmittance", medium.estimator,
                                    "Estimator for shadow rays. Delta: noisy. Ratio and residual ratio: less noise for "
                                    "more work. Regular: exact, visits all voxels"},
                                [owner](Document& d, TransmittanceEstimator v) {
                                  edit_medium(d, owner, [&](MediumDescription& m) { m.estimator = v; });
                                }));
}

void add_medium_emission(DocumentParameters& list, const MediumOwner& owner, const MediumDescription& medium) {
  add_triple(list, owner.section,
             {.names = {"medium-emission.r", "medium-emission.g", "medium-emission.b"},
              .label = "Medium emission",
              .value = Vec3(medium.emission.r, medium.emission.g, medium.emission.b),
              .range = {0, 1e6f},
              .doc = "Luminance of the medium where it is opaque; it emits in proportion to its absorption",
              .unit = "cd/m\u00b2"},
             [owner](Document& d, int c, float v) {
               edit_medium(d, owner, [&](MediumDescription& m) { m.emission[c] = v; });
             });
  list.push_back(make_parameter(
      owner.section,
      Number<float>{"medium-temperature",
                    "Medium temperature",
                    medium.temperature,
                    {0, 40000},
                    "Gives the emission the colour of a black body; where the density has a "
                    "temperature, this is the highest one. 0: the colour of the emission",
                    "K"},
      [owner](Document& d, float v) { edit_medium(d, owner, [&](MediumDescription& m) { m.temperature = v; }); }));
  if (!medium.emits()) list.back().inactive_reason = "The medium emits no light: set its emission and its absorption";
}

}  // namespace

void add_medium_parameters(DocumentParameters& list, const MediumOwner& owner, const MediumDescription& medium) {
  list.push_back(preset_choice(owner, medium));
  add_coefficient(list, owner, {"scattering.r", "scattering.g", "scattering.b"}, "Scattering", medium.scattering,
                  &MediumDescription::scattering, &MediumDescription::scattering_spectrum,
                  "Scattering coefficient of the medium: higher scatters light after a shorter distance");
  add_coefficient(list, owner, {"absorption.r", "absorption.g", "absorption.b"}, "Absorption", medium.absorption,
                  &MediumDescription::absorption, &MediumDescription::absorption_spectrum,
                  "Absorption coefficient of the medium: higher absorbs light after a shorter distance");
  add_coefficient_spectrum(list, owner, Coefficient::scattering, medium.scattering_spectrum);
  add_coefficient_spectrum(list, owner, Coefficient::absorption, medium.absorption_spectrum);
  add_phase_function(list, owner, medium);
  add_medium_emission(list, owner, medium);
  add_density(list, owner, medium);
}

}  // namespace etendue::render
