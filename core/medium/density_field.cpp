#include "medium/density_field.h"

#include <cassert>

#include "medium/density_registry.h"

namespace etendue {
namespace {

template <class Density>
const DensityInfo& density_info_of() {
  static const DensityInfo info{Density::kDescription, describe_all(Density().parameters())};
  return info;
}

template <class Density>
class DensityFieldOf final : public DensityField {
 public:
  explicit DensityFieldOf(const Density& density = {}) : density_(density) {}

  const DensityInfo& info() const override { return density_info_of<Density>(); }
  std::vector<ParameterInfo> parameters() const override {
    Density copy = density_;
    return describe_all(copy.parameters());
  }
  std::shared_ptr<const DensityField> with(std::string_view name, const Value& value) const override {
    Density changed = density_;
    [[maybe_unused]] const bool exists = assign_by_name(changed.parameters(), name, value);
    assert(exists);
    return std::make_shared<DensityFieldOf>(changed);
  }

 private:
  Result<GridValues> values() const override { return density_.values(); }

  Density density_;
};

struct DensityEntry {
  const DensityInfo* info;
  std::shared_ptr<const DensityField> (*make)();
};

template <class... Density>
std::vector<DensityEntry> density_entries_of(const std::tuple<Density...>*) {
  return {{&density_info_of<Density>(),
           []() -> std::shared_ptr<const DensityField> { return std::make_shared<DensityFieldOf<Density>>(); }}...};
}

const std::vector<DensityEntry>& density_entries() {
  static const std::vector<DensityEntry> all = density_entries_of(static_cast<const Densities*>(nullptr));
  return all;
}

std::string names_of_densities() {
  std::string names;
  for (const auto& e : density_entries()) names += (names.empty() ? "" : ", ") + std::string(e.info->description.name);
  return names;
}

}  // namespace

const std::vector<DensityInfo>& density_infos() {
  static const auto infos = [] {
    std::vector<DensityInfo> list;
    for (const auto& e : density_entries()) list.push_back(*e.info);
    return list;
  }();
  return infos;
}

std::shared_ptr<const DensityField> make_density(std::string_view name) {
  for (const auto& e : density_entries())
    if (e.info->description.name == name) return e.make();
  return nullptr;
}

Result<std::shared_ptr<const DensityField>> make_density(std::string_view name, const std::vector<Setting>& settings) {
  std::shared_ptr<const DensityField> density = make_density(name);
  if (!density)
    return usage_error("there is no density '" + std::string(name.substr(0, 40)) + "'; give one of " +
                       names_of_densities());
  for (const Setting& setting : settings) {
    const ParameterInfo* info = find_parameter(density->info().parameters, setting.name);
    if (!info)
      return usage_error("the density '" + std::string(name) + "' has no parameter '" + setting.name.substr(0, 40) +
                         "'");
    const auto value = checked_value(*info, setting.value);
    if (!value) return value.error();
    density = density->with(setting.name, *value);
  }
  return density;
}

const Result<std::shared_ptr<const DensityGrid>>& DensityField::grid() const {
  std::call_once(once_, [this] {
    auto sampled = values();
    if (sampled)
      grid_ = std::shared_ptr<const DensityGrid>(std::make_shared<DensityGrid>(std::move(*sampled)));
    else
      grid_ = sampled.error();
  });
  return grid_;
}

bool operator==(const DensityRef& a, const DensityRef& b) {
  if (a.field == b.field) return true;
  if (!a.field || !b.field || &a->info() != &b->info()) return false;
  const auto parameters_a = a->parameters(), parameters_b = b->parameters();
  for (size_t i = 0; i < parameters_a.size(); ++i)
    if (parameters_a[i].default_value != parameters_b[i].default_value) return false;
  return true;
}

}  // namespace etendue
