// Samplers: sources of the uniform numbers that a path consists of
//
// A sampler is a function of (pixel, sample index, dimension). Dimensions form blocks of eight with a fixed layout: one
// block for the camera and one for each path vertex. Dimension k is therefore the same decision in every path, which
// preserves the structure of low-discrepancy sequences. Markov chains in primary sample space use the same interface
// (primary_sample_sampler.h).
//
// To add a sampler, write a class like those in sobol.h or point_sets/lattice.h and add it to the list in registry.cpp.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <source_location>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/parameter.h"
#include "base/vec.h"

namespace etendue {

inline constexpr int kBlockSize = 8;
using SampleBlock = std::array<float, kBlockSize>;

// A set of dimensions of a block: bit k stands for dimension k.
using DimensionSet = uint32_t;
constexpr DimensionSet dimensions(int first, int count) { return ((1U << count) - 1) << first; }

// Layout of block 0 of a camera path. The comments give the number of dimensions.
namespace camera_dimension {
inline constexpr int kPixel = 0;       // 2: position in the pixel filter
inline constexpr int kLens = 2;        // 2
inline constexpr int kTime = 4;        // 1
inline constexpr int kWavelength = 5;  // 1: the hero wavelength; spectral models only
}  // namespace camera_dimension

// Layout of block 0 of a path that starts on a light.
namespace emission_dimension {
inline constexpr int kPoint = 0;      // 2: position on the light
inline constexpr int kDirection = 2;  // 2
inline constexpr int kTime = 4;       // 1
inline constexpr int kChoice = 5;     // 1: selection of the light
inline constexpr int kLens = 6;       // 2: lens point for the connection of the light to the camera
}  // namespace emission_dimension

// Layout of block 1 + k, which belongs to path vertex k (0 is the first hit).
namespace vertex_dimension {
inline constexpr int kBsdfDirection = 0;  // 2
inline constexpr int kLightPoint = 2;     // 2; in light paths the lens point for the connection to the camera
inline constexpr int kLightChoice = 4;    // 1
inline constexpr int kBsdfLobe = 5;       // 1
inline constexpr int kRoulette = 6;       // 1
inline constexpr int kFreeFlight = 7;  // 1: distance to a collision in a medium, on the segment that ends at the vertex
}  // namespace vertex_dimension

// One block of many paths: values[k][i] is dimension k of path i.
struct SampleTable {
  static constexpr size_t kPaths = 512;
  alignas(64) std::array<std::array<float, kPaths>, kBlockSize> values;
};

// What a sampler class states about itself.
struct SamplerDescription {
  const char* name;
  const char* label;
  const char* doc;           // its properties and limitations
  bool independent = false;  // its samples are statistically independent
  bool progressive = true;   // any number of samples is distributed evenly; false: whole groups of samples are
  bool for_study = false;    // for comparison: never chosen automatically
  // The number of dimensions that are distributed evenly together; 0: none are.
  int joint_dimensions;
  const char* padding;  // how the other dimensions are supplied
  // The source file that contains the description, for the manual.
  const char* file = std::source_location::current().file_name();
};

// A registered sampler, as shown by `list samplers`, the viewer and the manual.
struct SamplerInfo {
  std::string name, label, doc;
  std::vector<ParameterInfo> parameters;
  bool independent = false, progressive = true, for_study = false;
  int joint_dimensions = 0;
  std::string padding;
  const char* file;
};

class Sampler {
 public:
  virtual ~Sampler() = default;

  // Prepares tables for the samples [first, first + count) of all pixels. Called from one thread; afterwards, the
  // blocks of these samples may be computed from any thread.
  virtual void prepare([[maybe_unused]] uint32_t first, [[maybe_unused]] uint32_t count) {}

  // Eight values in [0, 1) of `sample` of the pixel with this seed. The seed is a hash of pixel, half-buffer and the
  // seed of the user; different seeds give statistically independent sequences.
  virtual void block(uint32_t pixel_seed, uint32_t sample, uint32_t block, SampleBlock& out) const = 0;

  // The same block of the same sample of up to SampleTable::kPaths pixels. Computes at least the `requested` dimensions
  // and returns those that were computed.
  virtual DimensionSet blocks(std::span<const uint32_t> pixel_seeds, uint32_t sample, uint32_t block,
                              DimensionSet requested, SampleTable& out) const;

  // The bits of a seed that are not random but select one of several sequences of the sampler.
  virtual uint32_t lane_mask() const { return 0; }

  // If above 0, the pixels of square tiles with a side of 2^b pixels share the lower 32 - 2b bits of their seeds, and the
  // upper ones are the place in the tile (place_in_tile). 0: pixels have independent seeds.
  virtual int tile_bits() const { return 0; }
};

// The seed of a pixel in a tile with a side of 2^bits pixels, from a hash of the tile: its upper 2 bits digits are the
// position on a Z-curve through the tile, with its binary digits reversed.
constexpr uint32_t place_in_tile(uint32_t tile, uint32_t x, uint32_t y, int bits) {
  uint32_t seed = tile & ((1U << (32 - 2 * bits)) - 1);
  for (int k = 0; k < bits; ++k) seed |= (x >> k & 1U) << (31 - 2 * k) | (y >> k & 1U) << (30 - 2 * k);
  return seed;
}

// All samplers in the order of the registry; the first one is the default.
const std::vector<SamplerInfo>& sampler_infos();
// The sampler of this name, or null.
const SamplerInfo* find_sampler(std::string_view name);

// A sampler with these settings, or null if the name is unknown. The values must have been checked against the
// parameters of the sampler; settings for other parameters are ignored.
std::unique_ptr<Sampler> make_sampler(std::string_view name, const std::vector<Setting>& settings = {});

// A seed for decisions that have no dimension in the layout, like stochastic opacity along a ray.
constexpr uint32_t path_seed(uint32_t pixel_seed, uint32_t sample) { return pixel_seed ^ (sample * 0x9e3779b9U); }

}  // namespace etendue
