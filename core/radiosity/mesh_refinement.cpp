#include "radiosity/mesh_refinement.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "radiosity/initial_irradiance.h"
#include "radiosity/reflectance.h"

namespace etendue::radiosity {
namespace {

constexpr size_t kPatchesPerTask = 64;
constexpr uint32_t kLightSamples = 16;  // at each point
constexpr size_t kParts = 4;            // of a divided patch
// The centroids of the parts.
constexpr std::array<Vec2, kParts> kCentroids{Vec2(1 / 6.0f, 1 / 6.0f), Vec2(1 / 3.0f, 1 / 3.0f),
                                              Vec2(1 / 6.0f, 2 / 3.0f), Vec2(2 / 3.0f, 1 / 6.0f)};

}  // namespace

MeshRefinement::MeshRefinement(const scene::CompiledScene& scene, const MeshSettings& settings, uint64_t seed)
    : settings_(settings), seed_(seed), mesh_(scene, settings) {
  // Not the sampler of the document: a comparison of samplers should have one mesh.
  std::unique_ptr<Sampler> sampler = make_sampler("sobol", {});
  sampler->prepare(0, kLightSamples);
  sampler_ = std::move(sampler);
  reflectance_ = patch_reflectances(scene, mesh_);
  error_.assign(mesh_.patches().size(), kUnknown);
}

int MeshRefinement::tasks() const {
  return is_ready() ? 0 : static_cast<int>((error_.size() + kPatchesPerTask - 1) / kPatchesPerTask);
}

std::optional<uint64_t> MeshRefinement::run(const scene::CompiledScene& scene, int task, const KeepGoing* keep_going) {
  const size_t first = static_cast<size_t>(task) * kPatchesPerTask;
  uint64_t rays = 0;
  for (size_t p = first; p < std::min(first + kPatchesPerTask, error_.size()); ++p) {
    if (error_[p] != kUnknown) continue;
    if (stops(keep_going)) return {};
    error_[p] = mesh_.patches()[p].area * squared_deviation(scene, static_cast<uint32_t>(p), rays);
  }
  return rays;
}

// The variance of the reflected direct light among the parts of a patch, for the side with the larger one.
float MeshRefinement::squared_deviation(const scene::CompiledScene& scene, uint32_t patch, uint64_t& rays) const {
  const float reflectance = luminance(reflectance_[patch]);
  if (!(reflectance > 0)) return 0;
  std::array<Vec3, kParts> points;
  for (size_t i = 0; i < kParts; ++i) points[i] = mesh_.patches()[patch].point(kCentroids[i]);
  float largest = 0;
  for (const uint32_t element : {2 * patch, 2 * patch + 1}) {
    std::array<Rgb, kParts> irradiance;
    irradiance_at_points(scene, mesh_, *sampler_, element, points, kLightSamples, seed_, irradiance, rays);
    float sum = 0, squares = 0;
    for (const Rgb& e : irradiance) {
      sum += luminance(e);
      squares += sqr(luminance(e));
    }
    largest = std::max(largest, squares / kParts - sqr(sum / kParts));
  }
  return sqr(reflectance) * largest;
}

void MeshRefinement::finish_round(const scene::CompiledScene& scene) {
  std::vector<uint32_t> parts_of;
  const size_t before = error_.size();
  PatchMesh refined = mesh_.refined(chosen(), &parts_of);
  // A patch that was not divided keeps its error.
  std::vector<float> errors(parts_of.size(), kUnknown);
  for (size_t p = 0; p < errors.size(); ++p)
    if (refined.patches()[p].area == mesh_.patches()[parts_of[p]].area) errors[p] = error_[parts_of[p]];
  mesh_ = std::move(refined);
  error_ = std::move(errors);
  if (error_.size() != before) reflectance_ = patch_reflectances(scene, mesh_);
  ++round_;
}

std::vector<char> MeshRefinement::chosen() const {
  std::vector<char> divided(error_.size(), 0);
  const size_t wanted = static_cast<size_t>(settings_.patches);
  if (wanted <= error_.size()) return divided;
  const auto rounds_left = static_cast<size_t>(kRounds - round_);
  const size_t count = std::min(error_.size(), (wanted - error_.size()) / ((kParts - 1) * rounds_left));
  std::vector<uint32_t> order(error_.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, std::greater(), [&](uint32_t p) { return error_[p]; });
  for (size_t i = 0; i < count; ++i)
    if (error_[order[i]] > 0) divided[order[i]] = 1;
  return divided;
}

PatchMesh complete_mesh(const scene::CompiledScene& scene, const MeshSettings& settings, uint64_t seed) {
  if (settings.meshing != Meshing::adaptive) return {scene, settings};
  MeshRefinement refinement(scene, settings, seed);
  while (!refinement.is_ready()) {
    for (int task = 0; task < refinement.tasks(); ++task) refinement.run(scene, task, nullptr);
    refinement.finish_round(scene);
  }
  return refinement.mesh();
}

}  // namespace etendue::radiosity
