// Every reflection model of the registry at the ends of all its knobs: what a test of all models goes through.
#pragma once
#include <random>
#include <string>
#include <vector>

#include "base/hash.h"
#include "bsdf/all_lobes.h"
#include "bsdf/bsdf_model.h"
#include "support/directions.h"

namespace etendue::test {

using ModelPtr = std::shared_ptr<const BsdfModel>;

struct ModelCase {
  std::string name;  // the model's and what was set
  ModelPtr model;
  AllLobes<Rgb> lobes;
};

inline const Rgb kModelBase{0.8f, 0.6f, 0.4f};

inline AllLobes<Rgb> lobes_of(const BsdfModel& model, const Rgb& base = kModelBase) {
  AllLobes<Rgb> lobes;
  model.add_lobes(base, lobes);
  return lobes;
}

// A model with some of its knobs set; an unknown name or value is a mistake of the test.
inline ModelPtr model_with(std::string_view name, const std::vector<std::pair<std::string, std::string>>& settings) {
  ModelPtr model = make_bsdf_model(name);
  for (const auto& [knob, text] : settings) {
    const auto parameters = model->parameters();
    const ParameterInfo* p = find_parameter(parameters, knob);
    if (!p) throw std::runtime_error(std::string(name) + " has no knob " + knob);
    const auto value = parse_value(*p, text);
    if (!value) throw std::runtime_error(value.error().message);
    model = model->with(knob, *value);
  }
  return model;
}

// Sets a number, and all three parts of a triple for its first.
inline ModelPtr with_number(ModelPtr model, const std::string& name, const Value& value) {
  model = model->with(name, value);
  if (name.ends_with(".r")) {
    const std::string stem = name.substr(0, name.size() - 2);
    model = model->with(stem + ".g", value)->with(stem + ".b", value);
  }
  return model;
}

// Calls use(name, model) for a model as it is, with each knob at both its ends or at each of its options, and with each
// of its presets.
template <class Use>
void for_each_setting(const BsdfModelInfo& info, Use&& use) {
  const std::string name = info.description.name;
  const ModelPtr usual = make_bsdf_model(name);
  use(name, usual);
  for (const auto& p : info.parameters) {
    if (p.name.ends_with(".g") || p.name.ends_with(".b")) continue;
    const auto set = [&](const Value& v) {
      if (v != p.default_value) use(name + " " + p.name + " " + to_string(v), with_number(usual, p.name, v));
    };
    switch (p.type) {
      case ParameterType::toggle:
        set(!std::get<bool>(p.default_value));
        break;
      case ParameterType::integer:
        set(static_cast<int64_t>(p.min)), set(static_cast<int64_t>(p.max));
        break;
      case ParameterType::number:
        set(p.min), set(p.max);
        break;
      case ParameterType::choice:
        for (const auto& option : p.options) set(option);
    }
  }
  for (const auto& preset : info.presets) use(name + " preset " + preset.name, with_preset(usual, preset.name));
}

inline std::vector<ModelCase> cases_of(std::string_view model) {
  std::vector<ModelCase> cases;
  for_each_setting(*find_bsdf_model(model), [&](const std::string& name, const ModelPtr& set) {
    cases.push_back({name, set, lobes_of(*set)});
  });
  return cases;
}

// Of all models together.
inline size_t count_cases() {
  size_t count = 0;
  for (const auto& info : bsdf_model_infos())
    for_each_setting(info, [&](const std::string&, const ModelPtr&) { ++count; });
  return count;
}

}  // namespace etendue::test
