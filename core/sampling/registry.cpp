// The registry of samplers.
#include <functional>

#include "sampling/antithetic.h"
#include "sampling/blue_noise.h"
#include "sampling/halton.h"
#include "sampling/pmj02.h"
#include "sampling/point_sets/faure.h"
#include "sampling/point_sets/hammersley.h"
#include "sampling/point_sets/hexagonal_grid.h"
#include "sampling/point_sets/latin_hypercube.h"
#include "sampling/point_sets/lattice.h"
#include "sampling/point_sets/niederreiter.h"
#include "sampling/point_sets/orthogonal_array.h"
#include "sampling/point_sets/poisson_disk.h"
#include "sampling/point_sets/regular_grid.h"
#include "sampling/point_sets/zaremba.h"
#include "sampling/random.h"
#include "sampling/sobol.h"
#include "sampling/stratified.h"

namespace etendue {
namespace {

struct Entry {
  SamplerInfo info;
  std::function<std::unique_ptr<Sampler>(const std::vector<Setting>&)> make;
};

template <class T>
Entry entry() {
  constexpr const SamplerDescription& description = T::kDescription;
  T defaults;
  return {
      .info = {.name = description.name,
               .label = description.label,
               .doc = description.doc,
               .parameters = describe_all(defaults.parameters()),
               .independent = description.independent,
               .progressive = description.progressive,
               .for_study = description.for_study,
               .joint_dimensions = description.joint_dimensions,
               .padding = description.padding,
               .file = description.file},
      .make =
          [](const std::vector<Setting>& settings) {
            auto sampler = std::make_unique<T>();
            for (const auto& s : settings) assign_by_name(sampler->parameters(), s.name, s.value);
            return sampler;
          },
  };
}

// One line per sampler; the first one is the default.
const std::vector<Entry>& entries() {
  static const std::vector<Entry> all{
      entry<SobolSampler>(),       entry<Pmj02Sampler>(),          entry<HaltonSampler>(),
      entry<StratifiedSampler>(),  entry<RandomSampler>(),         entry<NiederreiterSampler>(),
      entry<FaureSampler>(),       entry<LatticeSampler>(),        entry<ZarembaSampler>(),
      entry<HammersleySampler>(),  entry<LatinHypercubeSampler>(), entry<OrthogonalArraySampler>(),
      entry<PoissonDiskSampler>(), entry<RegularGridSampler>(),    entry<HexagonalGridSampler>(),
      entry<BlueNoiseSampler>(),   entry<AntitheticSampler>(),
  };
  return all;
}

}  // namespace

const std::vector<SamplerInfo>& sampler_infos() {
  static const auto infos = [] {
    std::vector<SamplerInfo> list;
    for (const auto& e : entries()) list.push_back(e.info);
    return list;
  }();
  return infos;
}

const SamplerInfo* find_sampler(std::string_view name) {
  for (const auto& info : sampler_infos())
    if (info.name == name) return &info;
  return nullptr;
}

std::unique_ptr<Sampler> make_sampler(std::string_view name, const std::vector<Setting>& settings) {
  for (const auto& e : entries())
    if (e.info.name == name) return e.make(settings);
  return nullptr;
}

}  // namespace etendue
