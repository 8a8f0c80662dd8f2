// Every sampler, one line each; the first is the default.
#include <functional>
#include <type_traits>

#include "sampling/halton.h"
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
  T usual;
  return {{T::kName, T::kLabel, T::kDoc, describe_all(usual.knobs()), std::is_same_v<T, RandomSampler>},
          [](const std::vector<Setting>& settings) {
            auto sampler = std::make_unique<T>();
            for (const auto& s : settings) assign_by_name(sampler->knobs(), s.name, s.value);
            return sampler;
          }};
}

const std::vector<Entry>& entries() {
  static const std::vector<Entry> all{
      entry<SobolSampler>(),
      entry<HaltonSampler>(),
      entry<StratifiedSampler>(),
      entry<RandomSampler>(),
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

DimensionSet Sampler::blocks(std::span<const uint32_t> pixel_seeds, uint32_t sample, uint32_t block, DimensionSet,
                             SampleTable& out) const {
  SampleBlock one;
  for (size_t i = 0; i < pixel_seeds.size(); ++i) {
    this->block(pixel_seeds[i], sample, block, one);
    for (size_t k = 0; k < one.size(); ++k) out.values[k][i] = one[k];
  }
  return dimensions(0, kBlockSize);
}

std::unique_ptr<Sampler> make_sampler(std::string_view name, const std::vector<Setting>& settings) {
  for (const auto& e : entries())
    if (e.info.name == name) return e.make(settings);
  return nullptr;
}

}  // namespace etendue
