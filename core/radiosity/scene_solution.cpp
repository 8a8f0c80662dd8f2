#include "radiosity/scene_solution.h"

#include <algorithm>

namespace etendue::radiosity {
namespace {

constexpr size_t kElementsPerTask = 32;

}  // namespace

SceneSolution::SceneSolution(const SolutionPlan& plan, size_t elements, std::shared_ptr<const FormFactors> factors)
    : plan_(plan), factors_(std::move(factors)), direct_(elements) {
  if (!factors_) rows_.resize(elements);
}

int SceneSolution::tasks() const {
  return static_cast<int>((direct_.size() + kElementsPerTask - 1) / kElementsPerTask);
}

std::optional<uint64_t> SceneSolution::run(const scene::CompiledScene& scene, const PatchMesh& mesh, int task,
                                           const std::function<bool()>* keep_going) {
  static thread_local RowBuilder builder;
  uint64_t rays = 0;
  const size_t first = static_cast<size_t>(task) * kElementsPerTask;
  for (size_t i = first; i < std::min(first + kElementsPerTask, direct_.size()); ++i) {
    if (keep_going && !(*keep_going)()) return {};
    const auto element = static_cast<uint32_t>(i);
    if (!factors_) {
      builder.begin(direct_.size());
      rays += info_of(plan_.factors.method)
                  .add_row({scene, mesh, sampler_, element, plan_.factors.samples, plan_.seed, builder});
      rows_[i] = builder.finish();
    }
    direct_[i] = direct_irradiance(scene, mesh, sampler_, element, plan_.light_samples, plan_.seed, rays);
  }
  return rays;
}

void SceneSolution::finish(const PatchMesh& mesh, const std::vector<Rgb>& reflectance) {
  if (!factors_) factors_ = std::make_shared<const FormFactors>(std::move(rows_), element_areas(mesh));
  rows_ = {};
  field_ = solve_field(*factors_, reflectance, direct_, plan_.field);
  is_ready_ = true;
}

size_t SceneSolution::memory() const {
  constexpr size_t kColorsPerElement = 4;  // direct, and the three members of the field
  size_t bytes = (factors_ ? factors_->memory() : 0) + kColorsPerElement * direct_.size() * sizeof(Rgb);
  for (const auto& row : rows_) bytes += row.capacity() * sizeof(FormFactor);
  return bytes;
}

}  // namespace etendue::radiosity
