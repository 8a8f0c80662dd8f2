// Phase functions: the directional distribution of light scattered by a particle.          [Lang, sec. 4.2.4, eq. 4.203]
//
// p(x) depends on the cosine x of the angle between the directions of propagation before and after scattering; x = 1 is
// forward scattering. It is a density per solid angle, in 1/sr: 2 pi times its integral over x from -1 to 1 is 1.
//
// A phase function is a struct of parameters (base/parameter.h) in a header of its own under phase_functions/. It
// defines
//
//   static constexpr PhaseFunctionDescription kDescription{...};
//   auto parameters();                       // std::tie of its parameters
//   double eval(double x) const;             // p(x), 1/sr
//   double sample(double u) const;           // x with density 2 pi p(x), for a uniform u in [0, 1)
//   double mean_cosine() const;              // the asymmetry parameter, in [-1, 1]
//   void prepare();                          // optional: precomputes tables after a parameter has changed
//
// and is registered by one line of phase_registry.h. Sampling is exact: the density of a sampled direction is p itself.
// Cosines are double precision, because narrow forward peaks are not resolved by a float next to 1.
#pragma once
#include <memory>
#include <string_view>
#include <vector>

#include "base/vec.h"
#include "medium/phase_function_info.h"

namespace etendue {

// All phase functions, in the order of the registry.
const std::vector<PhaseFunctionInfo>& phase_function_infos();
// Null if no phase function has this name.
const PhaseFunctionInfo* find_phase_function(std::string_view name);

class PhaseFunction {
 public:
  virtual ~PhaseFunction() = default;

  virtual const PhaseFunctionInfo& info() const = 0;
  // The parameters of `info`, with the values of this phase function as defaults.
  virtual std::vector<ParameterInfo> parameters() const = 0;
  // A copy with one parameter changed. The value must have been checked against its description.
  virtual std::shared_ptr<const PhaseFunction> with(std::string_view name, const Value& value) const = 0;

  // p at the cosine x of the scattering angle, 1/sr. It is also the density per solid angle of `sample_cosine`.
  virtual double eval(double x) const = 0;
  // The cosine of the scattering angle for a uniform number in [0, 1); the azimuth is uniform.
  virtual double sample_cosine(double u) const = 0;
  virtual double mean_cosine() const = 0;

  // p for unit directions that point away from the scattering point, as at surfaces: light arrives from wi and leaves to
  // wo. 1/sr.
  float eval(const Vec3& wo, const Vec3& wi) const;
  // A direction wi with the density p per solid angle.
  Vec3 sample(const Vec3& wo, Vec2 u) const;

 protected:
  PhaseFunction() = default;
  PhaseFunction(const PhaseFunction&) = default;
  PhaseFunction& operator=(const PhaseFunction&) = default;
};

// A phase function with its default parameters; null if no phase function has this name.
std::shared_ptr<const PhaseFunction> make_phase_function(std::string_view name);
// With these parameters; an error names the invalid parameter and its range.
Result<std::shared_ptr<const PhaseFunction>> make_phase_function(std::string_view name,
                                                                 const std::vector<Setting>& settings);

// The phase function of a medium; null stands for isotropic scattering. Two are equal if their names and parameters are.
struct PhaseFunctionRef {
  std::shared_ptr<const PhaseFunction> function = nullptr;

  // Never null.
  const std::shared_ptr<const PhaseFunction>& get() const;
  const PhaseFunction* operator->() const { return get().get(); }
  friend bool operator==(const PhaseFunctionRef& a, const PhaseFunctionRef& b);
};

}  // namespace etendue
