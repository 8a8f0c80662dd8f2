#include "radiosity/scene_solution.h"

#include <algorithm>

namespace etendue::radiosity {
namespace {

constexpr size_t kElementsPerTask = 32;

const char* name_of(size_t stage, size_t solving) {
  return stage == 0         ? "computing form factors"
         : stage == solving ? "solving the radiosity equation"
                            : "assembling form factors";
}

}  // namespace

SceneSolution::SceneSolution(const SolutionPlan& plan, size_t elements, std::shared_ptr<const FormFactors> factors)
    : plan_(plan), factors_(std::move(factors)), direct_(elements) {
  std::unique_ptr<Sampler> sampler = make_sampler(plan.sampler.name, plan.sampler.settings);
  sampler->prepare(0, std::max(plan.factors.samples, plan.light_samples));
  sampler_ = std::move(sampler);
  if (!factors_) rows_.resize(elements);
  done_.resize(static_cast<size_t>(tasks_of(0)));
  row_progress_.resize(done_.size());
}

int SceneSolution::tasks() const { return tasks_of(0); }

int SceneSolution::tasks_of(size_t stage) const {
  if (stage == 0) return static_cast<int>((direct_.size() + kElementsPerTask - 1) / kElementsPerTask);
  if (stage == kSolving) return static_cast<int>(kComponents);
  if (factors_) return 0;
  return static_cast<int>(FormFactorAssembly::task_count(direct_.size()));
}

std::vector<const char*> SceneSolution::stage_names() {
  std::vector<const char*> names;
  for (size_t stage = 0; stage < kStages; ++stage) names.push_back(name_of(stage, kSolving));
  return names;
}

std::vector<SceneSolution::Stage> SceneSolution::stages() const {
  std::vector<Stage> list;
  for (size_t stage = stage_; stage < kStages; ++stage) list.push_back({name_of(stage, kSolving), tasks_of(stage)});
  return list;
}

std::optional<uint64_t> SceneSolution::run_stage(const scene::CompiledScene& scene, const PatchMesh& mesh, size_t stage,
                                                 int task, const KeepGoing* keep_going) {
  if (stage < stage_ || done_[static_cast<size_t>(task)]) return 0;
  std::optional<uint64_t> rays = 0;
  if (stage == 0)
    rays = compute_rows(scene, mesh, task, keep_going);
  else if (stage < kSolving && !assembly_->run(static_cast<int>(stage) - 1, task, keep_going))
    rays = std::nullopt;
  else if (stage == kSolving && !components_[static_cast<size_t>(task)]->run(keep_going))
    rays = std::nullopt;
  done_[static_cast<size_t>(task)] = rays.has_value() ? 1 : 0;
  return rays;
}

void SceneSolution::complete_stage(const PatchMesh& mesh, const std::vector<Rgb>& reflectance, size_t stage) {
  if (stage < stage_) return;
  if (stage == 0 && !factors_) begin_assembly(mesh);
  if (stage > 0 && stage < kSolving && assembly_) {
    assembly_->finish_step(static_cast<int>(stage) - 1);
    if (stage + 1 == kSolving) {
      factors_ = std::make_shared<const FormFactors>(assembly_->take());
      assembly_ = nullptr;
    }
  }
  if (stage == kSolving) end_solution();
  ++stage_;
  if (stage_ == kSolving) begin_solution(reflectance);
  if (stage_ < kStages) done_.assign(static_cast<size_t>(tasks_of(stage_)), 0);
}

std::optional<uint64_t> SceneSolution::compute_rows(const scene::CompiledScene& scene, const PatchMesh& mesh, int task,
                                                    const KeepGoing* keep_going) {
  static thread_local RowBuilder builder;
  const size_t first = static_cast<size_t>(task) * kElementsPerTask;
  RowProgress& progress = row_progress_[static_cast<size_t>(task)];
  uint64_t& rays = progress.rays;
  for (size_t i = first + progress.elements; i < std::min(first + kElementsPerTask, direct_.size()); ++i) {
    if (stops(keep_going)) return {};
    const auto element = static_cast<uint32_t>(i);
    if (!factors_) {
      builder.begin(direct_.size());
      rays += info_of(plan_.factors.method)
                  .add_row({scene, mesh, *sampler_, element, plan_.factors.samples, plan_.seed, builder});
      rows_[i] = builder.finish();
    }
    direct_[i] = direct_irradiance(scene, mesh, *sampler_, element, plan_.light_samples, plan_.seed, rays);
    ++progress.elements;
  }
  return rays;
}

void SceneSolution::begin_assembly(const PatchMesh& mesh) {
  assembly_ = std::make_unique<FormFactorAssembly>(std::move(rows_), element_areas(mesh));
  rows_ = {};
}

void SceneSolution::begin_solution(const std::vector<Rgb>& reflectance) {
  for (size_t c = 0; c < kComponents; ++c)
    components_[c] =
        std::make_unique<ComponentSolution>(*factors_, reflectance, direct_, static_cast<int>(c), plan_.field);
}

void SceneSolution::end_solution() {
  field_ = combined_field(components_, direct_.size());
  for (auto& component : components_) component = nullptr;
}

std::optional<uint64_t> SceneSolution::run(const scene::CompiledScene& scene, const PatchMesh& mesh, int task,
                                           const KeepGoing* keep_going) {
  return run_stage(scene, mesh, 0, task, keep_going);
}

void SceneSolution::finish(const PatchMesh& mesh, const std::vector<Rgb>& reflectance) {
  if (stage_ == 0) complete_stage(mesh, reflectance, 0);
  for (size_t stage = stage_; stage < kStages; ++stage) {
    for (int task = 0; task < tasks_of(stage); ++task) {
      if (stage == kSolving)
        components_[static_cast<size_t>(task)]->run(nullptr);
      else
        assembly_->run(static_cast<int>(stage) - 1, task, nullptr);
    }
    complete_stage(mesh, reflectance, stage);
  }
}

std::array<ResidualHistory, 3> SceneSolution::history() const {
  std::array<ResidualHistory, 3> list = field_.history;
  for (size_t c = 0; c < kComponents; ++c)
    if (components_[c]) list[c] = components_[c]->history();
  return list;
}

size_t SceneSolution::memory() const {
  constexpr size_t kColorsPerElement = 5;  // direct, and the four members of the field
  size_t bytes = (factors_ ? factors_->memory() : 0) + (assembly_ ? assembly_->memory() : 0) +
                 kColorsPerElement * direct_.size() * sizeof(Rgb);
  for (const auto& row : rows_) bytes += row.capacity() * sizeof(FormFactor);
  for (const auto& component : components_)
    if (component)
      bytes += direct_.size() * ComponentSolution::kBytesPerElement + solver_memory(plan_.field.solver, direct_.size());
  return bytes;
}

}  // namespace etendue::radiosity
