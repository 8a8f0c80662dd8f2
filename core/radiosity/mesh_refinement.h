// An adaptive mesh: patches are divided where direct light varies within them, which is mostly at the edges of shadows.
//                                                            [Lang, sec. 10.1.3; Cohen et al. 1986; Heckbert 1992]
//
// The error of constant elements in the norm of L^2 is the standard deviation of radiosity within a patch. A round
// measures it for new patches, from the irradiance at the centroids of the four parts that a patch would have, and divides
// the patches with the largest part in the total error. Indirect light varies little and does not take part.
#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "radiosity/keep_going.h"
#include "radiosity/patch_mesh.h"
#include "sampling/sampler.h"
#include "spectrum/rgb.h"

namespace etendue::radiosity {

class MeshRefinement {
 public:
  // Rounds of parallel tasks.
  static constexpr int kRounds = 6;

  // `settings` are those of an adaptive mesh, which has at most settings.patches in the end.
  MeshRefinement(const scene::CompiledScene& scene, const MeshSettings& settings, uint64_t seed);

  // The rounds that are complete; kRounds if the mesh is.
  int round() const { return round_; }
  bool is_ready() const { return round_ == kRounds; }
  // Of this round. They may run in any order, and finish_round follows the last one. Tasks that have been done are not
  // repeated.
  int tasks() const;
  // The number of rays; nothing if it was stopped, and the task is to be repeated.
  std::optional<uint64_t> run(const scene::CompiledScene& scene, int task, const KeepGoing* keep_going);
  void finish_round(const scene::CompiledScene& scene);

  const PatchMesh& mesh() const { return mesh_; }

  // Whether a refinement with the same arguments has the same result.
  bool is_same(const MeshSettings& settings, uint64_t seed) const { return settings_ == settings && seed_ == seed; }

 private:
  static constexpr float kUnknown = -1;

  float squared_deviation(const scene::CompiledScene& scene, uint32_t patch, uint64_t& rays) const;
  // The patches that this round divides.
  std::vector<char> chosen() const;

  MeshSettings settings_;
  uint64_t seed_;
  std::shared_ptr<const Sampler> sampler_;
  PatchMesh mesh_;
  std::vector<Rgb> reflectance_;  // by patch
  std::vector<float> error_;      // by patch: area times the variance of radiosity within it; kUnknown for new patches
  int round_ = 0;
};

// The mesh of any settings; an adaptive one is refined.
PatchMesh complete_mesh(const scene::CompiledScene& scene, const MeshSettings& settings, uint64_t seed);

}  // namespace etendue::radiosity
