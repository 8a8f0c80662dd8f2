// The radiosity of a scene: rows of form factors and direct light in parallel tasks, then the solution of the radiosity
// equation.
#pragma once
#include <functional>
#include <memory>
#include <optional>

#include "radiosity/initial_irradiance.h"
#include "radiosity/irradiance_field.h"
#include "sampling/sobol.h"

namespace etendue::radiosity {

// Everything that a solution depends on besides the scene.
struct SolutionPlan {
  FormFactorSettings factors;
  uint32_t light_samples = 64;
  uint64_t seed = 0;
  FieldSettings field;
};

class SceneSolution {
 public:
  // `factors` are those of an equal mesh, or null: they are computed.
  SceneSolution(const SolutionPlan& plan, size_t elements, std::shared_ptr<const FormFactors> factors = nullptr);

  // The number of tasks, which may run in any order and in parallel.
  int tasks() const;
  // Computes the rows of a task. Returns the number of rays, or nothing if `keep_going`, which may be null, returned
  // false: the task is to be repeated.
  std::optional<uint64_t> run(const scene::CompiledScene& scene, const PatchMesh& mesh, int task,
                              const std::function<bool()>* keep_going);
  // Solves the equation, after all tasks. `reflectance` is by patch.
  void finish(const PatchMesh& mesh, const std::vector<Rgb>& reflectance);
  bool is_ready() const { return is_ready_; }

  // Null until the solution is ready, unless they were given.
  const std::shared_ptr<const FormFactors>& factors() const { return factors_; }
  const IrradianceField& field() const { return field_; }
  // Direct irradiance by element.
  const std::vector<Rgb>& direct() const { return direct_; }
  size_t memory() const;

 private:
  SolutionPlan plan_;
  SobolSampler sampler_;
  std::vector<FormFactorRow> rows_;
  std::shared_ptr<const FormFactors> factors_;
  std::vector<Rgb> direct_;
  IrradianceField field_;
  bool is_ready_ = false;
};

}  // namespace etendue::radiosity
