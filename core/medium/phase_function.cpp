#include "medium/phase_function.h"

#include <cassert>

#include "base/frame.h"
#include "medium/phase_registry.h"

namespace etendue {
namespace {

template <class Function>
const PhaseFunctionInfo& info_of() {
  static const PhaseFunctionInfo info{Function::kDescription, describe_all(Function().parameters())};
  return info;
}

template <class Function>
class PhaseFunctionOf final : public PhaseFunction {
 public:
  explicit PhaseFunctionOf(const Function& function = {}) : function_(function) {
    if constexpr (requires { function_.prepare(); }) function_.prepare();
  }

  const PhaseFunctionInfo& info() const override { return info_of<Function>(); }
  std::vector<ParameterInfo> parameters() const override {
    Function copy = function_;
    return describe_all(copy.parameters());
  }
  std::shared_ptr<const PhaseFunction> with(std::string_view name, const Value& value) const override {
    Function changed = function_;
    [[maybe_unused]] const bool exists = assign_by_name(changed.parameters(), name, value);
    assert(exists);
    return std::make_shared<PhaseFunctionOf>(changed);
  }
  double eval(double x) const override { return function_.eval(x); }
  double sample_cosine(double u) const override { return function_.sample(u); }
  double mean_cosine() const override { return function_.mean_cosine(); }

 private:
  Function function_;
};

struct RegistryEntry {
  const PhaseFunctionInfo* info;
  std::shared_ptr<const PhaseFunction> (*make)();
};

template <class... Function>
std::vector<RegistryEntry> entries_of(const std::tuple<Function...>*) {
  return {{&info_of<Function>(),
           []() -> std::shared_ptr<const PhaseFunction> { return std::make_shared<PhaseFunctionOf<Function>>(); }}...};
}

const std::vector<RegistryEntry>& entries() {
  static const std::vector<RegistryEntry> all = entries_of(static_cast<const PhaseFunctions*>(nullptr));
  return all;
}

std::string names_of_all() {
  std::string names;
  for (const auto& e : entries()) names += (names.empty() ? "" : ", ") + std::string(e.info->description.name);
  return names;
}

}  // namespace

const std::vector<PhaseFunctionInfo>& phase_function_infos() {
  static const auto infos = [] {
    std::vector<PhaseFunctionInfo> list;
    for (const auto& e : entries()) list.push_back(*e.info);
    return list;
  }();
  return infos;
}

const PhaseFunctionInfo* find_phase_function(std::string_view name) {
  for (const auto& info : phase_function_infos())
    if (info.description.name == name) return &info;
  return nullptr;
}

std::shared_ptr<const PhaseFunction> make_phase_function(std::string_view name) {
  for (const auto& e : entries())
    if (e.info->description.name == name) return e.make();
  return nullptr;
}

Result<std::shared_ptr<const PhaseFunction>> make_phase_function(std::string_view name,
                                                                 const std::vector<Setting>& settings) {
  std::shared_ptr<const PhaseFunction> function = make_phase_function(name);
  if (!function)
    return usage_error("there is no phase function '" + std::string(name.substr(0, 40)) + "'; give one of " +
                       names_of_all());
  for (const Setting& setting : settings) {
    const ParameterInfo* info = find_parameter(function->info().parameters, setting.name);
    if (!info)
      return usage_error("the phase function '" + std::string(name) + "' has no parameter '" +
                         setting.name.substr(0, 40) + "'");
    const auto value = checked_value(*info, setting.value);
    if (!value) return value.error();
    function = function->with(setting.name, *value);
  }
  return function;
}

// |a - b|^2 / 2 = 1 - <a, b> resolves small angles, which the product of nearly parallel unit vectors does not.
float PhaseFunction::eval(const Vec3& wo, const Vec3& wi) const {
  const auto squared = [](const Vec3& v) {
    return static_cast<double>(v.x) * v.x + static_cast<double>(v.y) * v.y + static_cast<double>(v.z) * v.z;
  };
  const double cosine = -(static_cast<double>(wo.x) * wi.x + static_cast<double>(wo.y) * wi.y +
                          static_cast<double>(wo.z) * wi.z);
  const double x = cosine > 0 ? 1 - 0.5 * squared(wo + wi) : 0.5 * squared(wo - wi) - 1;
  return static_cast<float>(eval(std::clamp(x, -1.0, 1.0)));
}

Vec3 PhaseFunction::sample(const Vec3& wo, Vec2 u) const {
  const double x = sample_cosine(u.x);
  const auto sine = static_cast<float>(std::sqrt(std::max((1 - x) * (1 + x), 0.0)));
  const float azimuth = 2 * kPi * u.y;
  return Frame(-wo).to_world({sine * std::cos(azimuth), sine * std::sin(azimuth), static_cast<float>(x)});
}

const std::shared_ptr<const PhaseFunction>& PhaseFunctionRef::get() const {
  static const std::shared_ptr<const PhaseFunction> isotropic = make_phase_function("isotropic");
  return function ? function : isotropic;
}

bool operator==(const PhaseFunctionRef& a, const PhaseFunctionRef& b) {
  if (a.function == b.function) return true;
  if (&a->info() != &b->info()) return false;
  const auto parameters_a = a->parameters(), parameters_b = b->parameters();
  for (size_t i = 0; i < parameters_a.size(); ++i)
    if (parameters_a[i].default_value != parameters_b[i].default_value) return false;
  return true;
}

}  // namespace etendue
