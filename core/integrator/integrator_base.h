// What all methods have: a description that stands in one place, and knobs that describe themselves.
//
// Derived offers a static function info() that returns an IntegratorInfo and a std::tie of its parameters,
// `parameters()`.
#pragma once
#include "integrator/integrator.h"

namespace etendue::integrator {

template <class Derived>
class IntegratorBase : public Integrator {
 public:
  Number<int> max_depth{
      "max-depth",
      "Longest path",
      0,
      {0, 1000},
      "Path segments from camera to light: 1 is a light seen directly, 2 direct illumination, 0 no limit"};

  std::vector<ParameterInfo> parameter_infos() const final {
    return describe_all(const_cast<Derived&>(self()).parameters());
  }
  bool set(std::string_view name, const Value& value) final {
    return assign_by_name(static_cast<Derived&>(*this).parameters(), name, value);
  }

 protected:
  bool at_max_depth(int length) const { return max_depth > 0 && length >= max_depth; }
  const Derived& self() const { return static_cast<const Derived&>(*this); }
};

}  // namespace etendue::integrator
