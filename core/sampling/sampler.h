// Where the random numbers of a path come from.
//
// A sampler is a function of (pixel, sample index, dimension). Dimensions come in blocks of eight with a fixed layout,
// one block for the camera and one for each path vertex, so that dimension k means the same decision in every path and
// the structure of a low-discrepancy sequence survives. A Markov chain in primary sample space fits the same interface.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/parameter.h"
#include "base/vec.h"

namespace etendue {

inline constexpr int kBlockSize = 8;
using SampleBlock = std::array<float, kBlockSize>;

// Some dimensions of a block.
using DimensionSet = uint32_t;
constexpr DimensionSet dimensions(int first, int count) { return ((1U << count) - 1) << first; }

// The layout of block 0.
namespace camera_dimension {
inline constexpr int kPixel = 0;  // 2: position under the pixel filter
inline constexpr int kLens = 2;   // 2
inline constexpr int kTime = 4;   // 1
}  // namespace camera_dimension

// The layout of block 0 of a path that starts on a light.
namespace emission_dimension {
inline constexpr int kPoint = 0;      // 2: on the light
inline constexpr int kDirection = 2;  // 2
inline constexpr int kTime = 4;       // 1
inline constexpr int kChoice = 5;     // 1
inline constexpr int kLens = 6;       // 2: the point of the lens that sees the light itself
}  // namespace emission_dimension

// The layout of block 1 + k, path vertex k (0 is the first hit). One number is spare.
namespace vertex_dimension {
inline constexpr int kBsdfDirection = 0;  // 2
inline constexpr int kLightPoint = 2;     // 2; of a path that starts on a light, the point of the lens that sees it
inline constexpr int kLightChoice = 4;    // 1
inline constexpr int kBsdfLobe = 5;       // 1
inline constexpr int kRoulette = 6;       // 1
}  // namespace vertex_dimension

// One block of many paths, number by number: values[k] holds the k-th number of each.
struct SampleTable {
  static constexpr size_t kPaths = 512;
  alignas(64) std::array<std::array<float, kPaths>, kBlockSize> values;
};

// What a sampler is and what it is bad at; shown by `list samplers`, the viewer and the documentation.
struct SamplerInfo {
  std::string name, label, doc;
  std::vector<ParameterInfo> parameters;
  bool independent = false;  // its samples know nothing of each other
};

class Sampler {
 public:
  virtual ~Sampler() = default;

  // Called from one thread before samples [first, first + count) of every pixel are drawn: the place for tables that
  // all pixels share. Blocks of these samples may then be asked for from any thread.
  virtual void prepare(uint32_t first, uint32_t count) { (void)first, (void)count; }

  // Eight values in [0, 1) for `sample` of the pixel with this seed. The seed is a hash of pixel, replicate and the
  // user's seed: pixels with different seeds are independent replicates of each other.
  virtual void block(uint32_t pixel_seed, uint32_t sample, uint32_t block, SampleBlock& out) const = 0;

  // The same for up to SampleTable::kPaths pixels at once, which are all at the same sample and block. Returns the
  // dimensions that it wrote: those that are wanted, or more where they come together.
  virtual DimensionSet blocks(std::span<const uint32_t> pixel_seeds, uint32_t sample, uint32_t block,
                              DimensionSet wanted, SampleTable& out) const;

  // The bits of a seed that are not random but tell the sampler which of its own sequences is meant.
  virtual uint32_t lane_mask() const { return 0; }
};

// The registry: every sampler there is, in the order they are listed; sobol is the default.
const std::vector<SamplerInfo>& sampler_infos();
const SamplerInfo* find_sampler(std::string_view name);

// `settings` must have been checked against the parameters of the sampler; names it does not have are ignored.
std::unique_ptr<Sampler> make_sampler(std::string_view name, const std::vector<Setting>& settings = {});

// A seed for decisions that are no dimension of the integral's layout (stochastic opacity along a ray).
constexpr uint32_t path_seed(uint32_t pixel_seed, uint32_t sample) { return pixel_seed ^ (sample * 0x9e3779b9U); }

}  // namespace etendue
