#include "bsdf/bsdf_model.h"

#include <algorithm>
#include <cassert>

#include "bsdf/all_lobe_types.h"

namespace etendue {
namespace {

template <class Model>
std::vector<ModelPreset> presets_of() {
  if constexpr (requires { Model::presets(); })
    return Model::presets();
  else
    return {};
}

template <class Model>
const BsdfModelInfo& info_of() {
  static const BsdfModelInfo info{Model::kDescription, describe_all(Model().parameters()), presets_of<Model>()};
  return info;
}

template <class Model>
constexpr bool encloses_solid() {
  return requires { Model::kSolid; };
}

template <class Model>
class BsdfModelOf final : public BsdfModel {
 public:
  explicit BsdfModelOf(const Model& model = {}, bool is_prepared = !kNeedsPreparation)
      : model_(model), is_prepared_(is_prepared) {}

  const BsdfModelInfo& info() const override { return info_of<Model>(); }
  std::vector<ParameterInfo> parameters() const override {
    Model copy = model_;
    return describe_all(copy.parameters());
  }
  std::shared_ptr<const BsdfModel> with(std::string_view name, const Value& value) const override {
    Model changed = model_;
    [[maybe_unused]] const bool exists = assign_by_name(changed.parameters(), name, value);
    assert(exists);
    return std::make_shared<BsdfModelOf>(changed);
  }
  std::shared_ptr<const BsdfModel> prepared() const override {
    return is_prepared_ ? nullptr : std::make_shared<BsdfModelOf>(prepared_model(), true);
  }
  void add_lobes(const Rgb& base, AllLobes<Rgb>& lobes) const override {
    if (is_prepared_)
      model_.add_lobes(base, lobe_set(lobes));
    else
      prepared_model().add_lobes(base, lobe_set(lobes));
  }
  void add_unprepared_lobes(AllLobes<Rgb>& lobes) const override { model_.add_lobes(Rgb(1), lobe_set(lobes)); }
  bool is_solid() const override { return encloses_solid<Model>(); }
  Subsurface subsurface() const override {
    if constexpr (requires { model_.subsurface(); })
      return model_.subsurface();
    else
      return {};
  }
  float index_of_refraction() const override {
    if constexpr (encloses_solid<Model>())
      return model_.eta;
    else
      return 1;
  }

 private:
  static constexpr bool kNeedsPreparation = requires(Model model) { model.prepare(); };

  Model prepared_model() const {
    Model copy = model_;
    if constexpr (kNeedsPreparation) copy.prepare();
    return copy;
  }

  Model model_;
  bool is_prepared_;
};

struct RegistryEntry {
  const BsdfModelInfo* info;
  std::shared_ptr<const BsdfModel> (*make)();
};

template <class... Model>
std::vector<RegistryEntry> entries_of(TypeList<Model...>) {
  return {{&info_of<Model>(),
           []() -> std::shared_ptr<const BsdfModel> { return std::make_shared<BsdfModelOf<Model>>(); }}...};
}

const std::vector<RegistryEntry>& entries() {
  static const std::vector<RegistryEntry> all = entries_of(BsdfModels{});
  return all;
}

}  // namespace

const std::vector<BsdfModelInfo>& bsdf_model_infos() {
  static const auto infos = [] {
    std::vector<BsdfModelInfo> list;
    for (const auto& e : entries()) list.push_back(*e.info);
    return list;
  }();
  return infos;
}

const BsdfModelInfo* find_bsdf_model(std::string_view name) {
  for (const auto& info : bsdf_model_infos())
    if (info.description.name == name) return &info;
  return nullptr;
}

std::shared_ptr<const BsdfModel> make_bsdf_model(std::string_view name) {
  for (const auto& e : entries())
    if (e.info->description.name == name) return e.make();
  return nullptr;
}

std::string_view preset_of(const BsdfModel& model) {
  const auto parameters = model.parameters();
  const auto has_value = [&](const std::pair<std::string, Value>& setting) {
    const ParameterInfo* p = find_parameter(parameters, setting.first);
    return p && p->default_value == setting.second;
  };
  for (const ModelPreset& preset : model.info().presets)
    if (std::all_of(preset.values.begin(), preset.values.end(), has_value)) return preset.name;
  return kNoPreset;
}

std::shared_ptr<const BsdfModel> with_preset(std::shared_ptr<const BsdfModel> model, std::string_view name) {
  for (const ModelPreset& preset : model->info().presets)
    if (preset.name == name)
      for (const auto& [parameter, value] : preset.values) model = model->with(parameter, value);
  return model;
}

bool operator==(const BsdfModelRef& a, const BsdfModelRef& b) {
  if (a.model == b.model) return true;
  if (!a.model || !b.model || &a->info() != &b->info()) return false;
  const auto parameters_a = a->parameters(), parameters_b = b->parameters();
  for (size_t i = 0; i < parameters_a.size(); ++i)
    if (parameters_a[i].default_value != parameters_b[i].default_value) return false;
  return true;
}

}  // namespace etendue
