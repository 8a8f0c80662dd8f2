// The input of the denoiser
#pragma once
#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "film/half_buffers.h"
#include "spectrum/rgb.h"

namespace etendue::film {

// Albedo, normal and depth.
inline constexpr size_t kDenoiseFeatures = 7;

// One plane per feature, each with one value per pixel, of the order of 1. Empty planes: no features.
using FeaturePlanes = std::array<std::vector<float>, kDenoiseFeatures>;

struct DenoiseInput {
  int width = 0;
  int height = 0;
  std::array<std::vector<Rgb>, kHalfBuffers> half_buffers;  // means, linear radiance, row by row
  std::array<FeaturePlanes, kHalfBuffers> features;         // with independent noise
};

// Calls `task(i)` for each i in [0, count), in any order and from any thread, and returns when all are done.
using ForEach = std::function<void(int count, const std::function<void(int)>& task)>;

}  // namespace etendue::film
