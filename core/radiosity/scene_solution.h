// The radiosity of a scene in stages of parallel tasks: rows of form factors and direct light, the assembly of the form
// factors, the solution of the radiosity equation.
#pragma once
#include <functional>
#include <memory>
#include <optional>

#include "radiosity/form_factor_assembly.h"
#include "radiosity/initial_irradiance.h"
#include "radiosity/irradiance_field.h"

namespace etendue::radiosity {

// A sampler by name, with its parameters.
struct SamplerChoice {
  std::string name = "sobol";
  std::vector<Setting> settings = {};
};

// Everything that a solution depends on besides the scene.
struct SolutionPlan {
  FormFactorSettings factors;
  uint32_t light_samples = 64;
  uint64_t seed = 0;
  FieldSettings field;
  SamplerChoice sampler = {};
};

class SceneSolution {
 public:
  // `factors` are those of an equal mesh, or null: they are computed.
  SceneSolution(const SolutionPlan& plan, size_t elements, std::shared_ptr<const FormFactors> factors = nullptr);

  struct Stage {
    const char* name;
    int tasks;
  };
  // The names of all stages, in their order.
  static std::vector<const char*> stage_names();
  // The number of tasks of a stage that is next or later.
  int tasks_of(size_t stage) const;
  // The stages that have not been completed, in their order.
  std::vector<Stage> stages() const;
  // The number of the first of them.
  size_t first_stage() const { return stage_; }

  // The tasks of a stage may run in any order and in parallel, and complete_stage follows the last one. Returns the number of rays, or nothing if `keep_going`, which may be null, returned false: the task is to
  // be repeated, and continues where it was stopped. Tasks that have been done are not repeated.
  std::optional<uint64_t> run_stage(const scene::CompiledScene& scene, const PatchMesh& mesh, size_t stage, int task,
                                    const KeepGoing* keep_going);
  // `reflectance` is by patch.
  void complete_stage(const PatchMesh& mesh, const std::vector<Rgb>& reflectance, size_t stage);
  bool is_ready() const { return stage_ == kStages; }

  // The tasks of the first stage, and all other stages one after the other.
  int tasks() const;
  std::optional<uint64_t> run(const scene::CompiledScene& scene, const PatchMesh& mesh, int task,
                              const KeepGoing* keep_going);
  void finish(const PatchMesh& mesh, const std::vector<Rgb>& reflectance);

  // Null until they are assembled, unless they were given.
  const std::shared_ptr<const FormFactors>& factors() const { return factors_; }
  const IrradianceField& field() const { return field_; }
  // Direct irradiance by element.
  const std::vector<Rgb>& direct() const { return direct_; }
  // The residuals so far. Not while tasks run.
  std::array<ResidualHistory, 3> history() const;
  size_t memory() const;

 private:
  static constexpr size_t kComponents = 3;
  // Rows; the steps of the assembly; the solution.
  static constexpr size_t kSolving = 1 + FormFactorAssembly::kSteps, kStages = kSolving + 1;

  std::optional<uint64_t> compute_rows(const scene::CompiledScene& scene, const PatchMesh& mesh, int task,
                                       const KeepGoing* keep_going);
  void begin_assembly(const PatchMesh& mesh);
  void begin_solution(const std::vector<Rgb>& reflectance);
  void end_solution();

  SolutionPlan plan_;
  std::shared_ptr<const Sampler> sampler_;
  size_t stage_ = 0;
  std::vector<char> done_;  // by task of the stage
  struct RowProgress {
    size_t elements = 0;  // that are done
    uint64_t rays = 0;    // of these
  };
  std::vector<RowProgress> row_progress_;  // by task of the first stage
  std::vector<FormFactorRow> rows_;
  std::unique_ptr<FormFactorAssembly> assembly_;
  std::shared_ptr<const FormFactors> factors_;
  std::vector<Rgb> direct_;
  std::array<std::unique_ptr<ComponentSolution>, kComponents> components_;
  IrradianceField field_;
};

}  // namespace etendue::radiosity
