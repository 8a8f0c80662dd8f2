#include "radiosity/parameters.h"

#include <algorithm>

#include "radiosity/reconstruction.h"

namespace etendue::radiosity {

size_t memory_of(size_t patches, const Parameters& parameters, size_t solutions) {
  constexpr size_t kComponents = 3;
  const size_t elements = 2 * patches;
  const FormFactorSettings settings = parameters.factor_settings();
  const size_t stored = stored_memory(elements, settings);
  const size_t solver =
      kComponents * (elements * ComponentSolution::kBytesPerElement + solver_memory(parameters.solver, elements));
  const size_t building = std::max(largest_memory(elements, settings), stored + solver);
  // Direct light, the four members of a field, and what images look up: values at elements or at vertices.
  constexpr size_t kColors = 5 + 2 * 3;
  const size_t mesh = parameters.meshing == Meshing::adaptive ? PatchMesh::kBytesPerRefinedPatch : sizeof(Patch);
  return patches * (mesh + PatchVertices::kBytesPerPatch + sizeof(Rgb)) + solutions * elements * kColors * sizeof(Rgb) +
         (solutions - 1) * stored + building;
}

std::string too_many_patches(const scene::CompiledScene& scene, const Parameters& parameters, size_t solutions) {
  constexpr size_t kMebibyte = size_t{1} << 20;
  const size_t count = count_patches(scene, parameters.mesh_settings());
  const size_t limit = static_cast<size_t>(parameters.memory_limit) * kMebibyte;
  const size_t needed = memory_of(count, parameters, solutions);
  if (needed <= limit) return {};
  size_t fits = 0, too_many = count;
  while (too_many - fits > 1) {
    const size_t middle = fits + (too_many - fits) / 2;
    (memory_of(middle, parameters, solutions) <= limit ? fits : too_many) = middle;
  }
  return "the radiosity of " + std::to_string(count) + " patches may need " +
         std::to_string((needed + kMebibyte - 1) / kMebibyte) + " MiB, more than radiosity.memory-limit (" +
         std::to_string(parameters.memory_limit) + " MiB): at most " + std::to_string(fits) +
         " patches fit; lower radiosity.patches" +
         (info_of(parameters.factors).samples_pairs ? "" : " or radiosity.rays") + ", or raise the limit";
}

}  // namespace etendue::radiosity
