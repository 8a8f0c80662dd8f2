// Densities of heterogeneous media: factors on the coefficients of a medium that depend on the position.
//
// A density fills the bounding box of its medium. It is sampled at the nodes of a grid when it is used for the first time
// (density_grid.h); rendering reads the grid.
//
// A density is a struct of parameters (base/parameter.h) in a header of its own under densities/. It defines
//
//   static constexpr DensityDescription kDescription{...};
//   auto parameters();                   // std::tie of its parameters
//   Result<GridValues> values() const;   // at the nodes of a grid; an error says why there are none
//
// and is registered by one line of density_registry.h.
#pragma once
#include <memory>
#include <mutex>
#include <string_view>
#include <vector>

#include "medium/density_grid.h"
#include "medium/density_info.h"

namespace etendue {

// All densities, in the order of the registry.
const std::vector<DensityInfo>& density_infos();

class DensityField {
 public:
  virtual ~DensityField() = default;

  virtual const DensityInfo& info() const = 0;
  // The parameters of `info`, with the values of this density as defaults.
  virtual std::vector<ParameterInfo> parameters() const = 0;
  // A copy with one parameter changed. The value must have been checked against its description.
  virtual std::shared_ptr<const DensityField> with(std::string_view name, const Value& value) const = 0;

  // The density on a grid; the error of `values` if there is none. Computed at the first call; thread-safe.
  const Result<std::shared_ptr<const DensityGrid>>& grid() const;

 protected:
  DensityField() = default;
  virtual Result<GridValues> values() const = 0;

 private:
  mutable std::once_flag once_;
  mutable Result<std::shared_ptr<const DensityGrid>> grid_ = std::shared_ptr<const DensityGrid>();
};

// A density with its default parameters; null if no density has this name.
std::shared_ptr<const DensityField> make_density(std::string_view name);
// With these parameters; an error names the invalid parameter and its range.
Result<std::shared_ptr<const DensityField>> make_density(std::string_view name, const std::vector<Setting>& settings);

// The density of a medium; null stands for a homogeneous medium. Two are equal if their names and parameters are.
struct DensityRef {
  std::shared_ptr<const DensityField> field = nullptr;

  explicit operator bool() const { return field != nullptr; }
  const DensityField* operator->() const { return field.get(); }
  friend bool operator==(const DensityRef& a, const DensityRef& b);
};

}  // namespace etendue
