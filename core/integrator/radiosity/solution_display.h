// What a radiosity solution shows besides the image: statistics, points, patches, the work of the solver.
#pragma once
#include <memory>
#include <vector>

#include "integrator/integrator_info.h"
#include "integrator/solution_view.h"

namespace etendue::radiosity {
class PatchMesh;
class PatchVertices;
class SceneSolution;
}  // namespace etendue::radiosity

namespace etendue::integrator {

// The centroids of patches with the power that they reflect, `most` at most. The solution must be ready.
std::shared_ptr<const std::vector<StoredPoint>> patch_points(const radiosity::PatchMesh& mesh,
                                                             const std::vector<Rgb>& reflectance,
                                                             const radiosity::SceneSolution& solution, size_t most);

// The solution must be ready. `vertices` may be empty.
std::vector<Statistic> solution_statistics(const radiosity::PatchMesh& mesh, const radiosity::PatchVertices& vertices,
                                           const radiosity::SceneSolution& solution);

// As far as it is known.
std::shared_ptr<SolutionView> view_of(const radiosity::PatchMesh& mesh, const std::vector<Rgb>& reflectance,
                                      const radiosity::SceneSolution& solution);

}  // namespace etendue::integrator
