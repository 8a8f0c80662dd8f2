// Denoising of an image by first-order regression on features of the visible surfaces
//
// Near each pixel, the radiance is modelled as a linear function of the features (albedo, normal, depth) of the
// surfaces, and fitted by weighted least squares [Bitterli et al. 2016]. The weights compare patches of pixels
// (non-local means) [Rousselle et al. 2012]. The weights of one half-buffer come from the other one, so the noise of a
// pixel does not influence its own weight. Each half-buffer is filtered with two bandwidths. The error of each result,
// and of the image without filter, is estimated by comparison with the other half-buffer; the best one is chosen per
// pixel. In contrast to the paper, each fit is evaluated at its centre only, and the variance is estimated from the
// half-buffers alone.
//
// The result is biased: detail of the radiance that no feature shows (shadows, caustics, reflections) is blurred by the
// amount that its noise hides. It is for display only; errors are measured on the image without filter.
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "film/film.h"
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

// Feature planes from values with three, three and one channel per pixel. The depth is multiplied by `depth_scale`.
FeaturePlanes feature_planes(const std::vector<float>& albedo, const std::vector<float>& normal,
                             const std::vector<float>& depth, float depth_scale);

// The means of the half-buffers of a film. Pixels that lack samples of one half-buffer have the mean of the other one.
std::array<std::vector<Rgb>, kHalfBuffers> half_buffer_means(const Film& film);

// Calls `task(i)` for each i in [0, count), in any order and from any thread, and returns when all are done.
using ForEach = std::function<void(int count, const std::function<void(int)>& task)>;

// The denoised image. It does not depend on the order of the tasks. Values that are not finite count as missing.
std::vector<Rgb> denoise(const DenoiseInput& input, const ForEach& for_each);

}  // namespace etendue::film
