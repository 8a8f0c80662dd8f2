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
#include <vector>

#include "film/denoise/denoise_input.h"
#include "film/film.h"
#include "film/half_buffers.h"
#include "spectrum/rgb.h"

namespace etendue::film {

// Feature planes from values with three, three and one channel per pixel. The depth is multiplied by `depth_scale`.
FeaturePlanes feature_planes(const std::vector<float>& albedo, const std::vector<float>& normal,
                             const std::vector<float>& depth, float depth_scale);

// The means of the half-buffers of a film. Pixels that lack samples of one half-buffer have the mean of the other one.
std::array<std::vector<Rgb>, kHalfBuffers> half_buffer_means(const Film& film);

// The denoised image. It does not depend on the order of the tasks. Values that are not finite count as missing.
std::vector<Rgb> denoise(const DenoiseInput& input, const ForEach& for_each);

}  // namespace etendue::film
