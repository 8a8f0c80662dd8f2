// The cases of tests over all BSDF models: every model of the registry with each parameter at the ends of its range.
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
using Settings = std::vector<std::pair<std::string, std::string>>;  // names and values of parameters

struct ModelCase {
  std::string name;  // model and changed parameter
  ModelPtr model;
  AllLobes<Rgb> lobes;
};

inline const Rgb kModelBase{0.8f, 0.6f, 0.4f};

inline AllLobes<Rgb> lobes_of(const BsdfModel& model, const Rgb& base = kModelBase) {
  AllLobes<Rgb> lobes;
  model.add_lobes(base, lobes);
  return lobes;
}

// The model with these parameters. Throws if a name or a value is invalid.
inline ModelPtr with_settings(ModelPtr model, const Settings& settings) {
  for (const auto& [name, text] : settings) {
    const auto parameters = model->parameters();
    const ParameterInfo* p = find_parameter(parameters, name);
    if (!p) throw std::runtime_error(std::string(model->info().description.name) + " has no parameter " + name);
    const auto value = parse_value(*p, text);
    if (!value) throw std::runtime_error(value.error().message);
    model = model->with(name, *value);
  }
  return model;
}
inline ModelPtr model_with(std::string_view name, const Settings& settings) {
  return with_settings(make_bsdf_model(name), settings);
}

// Sets a parameter; for the first component of a triple, all three.
inline ModelPtr with_number(ModelPtr model, const std::string& name, const Value& value) {
  model = model->with(name, value);
  if (name.ends_with(".r")) {
    const std::string stem = name.substr(0, name.size() - 2);
    model = model->with(stem + ".g", value)->with(stem + ".b", value);
  }
  return model;
}

// Calls use(name, model) for the default model, for each parameter at both ends of its range or at each option, and for
// each preset.
template <class Use>
void for_each_setting(const BsdfModelInfo& info, Use&& use) {
  const std::string name = info.description.name;
  const ModelPtr default_model = make_bsdf_model(name);
  use(name, default_model);
  for (const auto& p : info.parameters) {
    if (p.name.ends_with(".g") || p.name.ends_with(".b")) continue;
    const auto use_value = [&](const Value& v) {
      if (v != p.default_value) use(name + " " + p.name + " " + to_string(v), with_number(default_model, p.name, v));
    };
    switch (p.type) {
      case ParameterType::toggle:
        use_value(!std::get<bool>(p.default_value));
        break;
      case ParameterType::integer:
        use_value(static_cast<int64_t>(p.min));
        use_value(static_cast<int64_t>(p.max));
        break;
      case ParameterType::number:
        use_value(p.min);
        use_value(p.max);
        break;
      case ParameterType::choice:
        for (const auto& option : p.options) use_value(option);
    }
  }
  for (const auto& preset : info.presets) use(name + " preset " + preset.name, with_preset(default_model, preset.name));
}

inline std::vector<ModelCase> cases_of(std::string_view model) {
  std::vector<ModelCase> cases;
  for_each_setting(*find_bsdf_model(model), [&](const std::string& name, const ModelPtr& variant) {
    cases.push_back({name, variant, lobes_of(*variant)});
  });
  return cases;
}

// The number of cases of all models.
inline size_t count_cases() {
  size_t count = 0;
  for (const auto& info : bsdf_model_infos())
    for_each_setting(info, [&](const std::string&, const ModelPtr&) { ++count; });
  return count;
}

}  // namespace etendue::test
