#include "radiosity/parameters.h"

namespace etendue::radiosity {

std::string too_many_patches(const scene::CompiledScene& scene, const Parameters& parameters, size_t solutions) {
  constexpr size_t kMebibyte = size_t{1} << 20, kSides = 2;
  const size_t count = count_patches(scene, parameters.mesh_settings());
  const size_t limit = static_cast<size_t>(parameters.memory_limit) * kMebibyte / solutions;
  const FormFactorSettings settings = parameters.factor_settings();
  const size_t most = most_elements(limit, settings) / kSides;
  if (count <= most) return {};
  const size_t needed = solutions * largest_memory(kSides * count, settings) / kMebibyte;
  return "the form factors of " + std::to_string(count) + " patches may need " + std::to_string(needed) +
         " MiB, more than radiosity.memory-limit (" + std::to_string(parameters.memory_limit) + " MiB): at most " +
         std::to_string(most) + " patches fit; lower radiosity.patches" +
         (info_of(settings.method).samples_pairs ? "" : " or radiosity.rays") + ", or raise the limit";
}

}  // namespace etendue::radiosity
