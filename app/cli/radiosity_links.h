// Hierarchical form factors for `etendue radiosity --links`.
#pragma once
#include <optional>
#include <string>

#include "json.h"
#include "radiosity/hierarchy.h"

namespace etendue::cli {

// A mesh of quadtrees with flat form factors.
struct FlatSolution {
  const scene::CompiledScene& scene;
  const radiosity::PatchMesh& mesh;
  const std::vector<Rgb>&reflectance, &direct;
  const radiosity::FormFactors& factors;
  radiosity::SolverSettings settings;
};

// Hierarchical form factors of the same mesh, and their solution with the same direct light.
struct HierarchyRun {
  size_t links = 0, memory = 0;
  double seconds = 0;
  uint64_t rays = 0;
  double mean_closure = 0;  // over the area of the sides that see another one
  double difference = 0;  // mean absolute difference of indirect irradiance to flat form factors, relative to its mean
  std::string problem;
};

// Nothing if it was interrupted.
std::optional<HierarchyRun> run_hierarchy(const FlatSolution& flat, const radiosity::HierarchySettings& settings,
                                          int threads);

void print(const HierarchyRun& run);
json hierarchy_json(const HierarchyRun& run);

}  // namespace etendue::cli
