// The common base of integrators (CRTP): parameters and the path length limit.
//
// Derived offers a static function info() that returns an IntegratorInfo, and parameters(), a std::tie of its
// parameters.
#pragma once
#include "integrator/integrator.h"

namespace etendue::integrator {

template <class Derived>
class IntegratorBase : public Integrator {
 public:
  Number<int> max_depth{
      "max-depth",
      "Max. path length",
      0,
      {0, 1000},
      "Segments from camera to light: 1 is directly visible light, 2 direct illumination, 0 no limit"};

  std::vector<ParameterInfo> parameter_infos() const final {
    return describe_all(const_cast<Derived&>(self()).parameters());
  }
  bool set(std::string_view name, const Value& value) final {
    return assign_by_name(static_cast<Derived&>(*this).parameters(), name, value);
  }
  SampledPaths sampled_paths(const scene::CompiledScene*) const override {
    IntegratorInfo info = Derived::info();
    return {std::move(info.paths), std::move(info.point_paths)};
  }

 protected:
  bool at_max_depth(int length) const { return max_depth > 0 && length >= max_depth; }
  const Derived& self() const { return static_cast<const Derived&>(*this); }
};

}  // namespace etendue::integrator
