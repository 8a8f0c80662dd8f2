// Denoising of an image by first-order regression on features of the visible surfaces
//
// Near each pixel, the radiance is modelled as a linear function of the features (albedo, normal, depth) of the
// surfaces, and fitted by weighted least squares [Bitterli et al. 2016]. The weights compare patches of pixels
// (non-local means) [Rousselle et al. 2012]. The weights of one half-buffer come from the other one, so the noise of a
// pixel does not influence its own weight. The result is the mean of both filtered half-buffers. In contrast to the
// paper, the features are not filtered, the bandwidth is constant, and each fit is evaluated at its centre only.
//
// The result is biased: detail of the radiance that no feature shows (shadows, caustics, reflections) is blurred by the
// amount that its noise hides.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "film/film.h"
#include "film/half_buffers.h"
#include "spectrum/rgb.h"

namespace etendue::film {

// Albedo, normal and depth.
inline constexpr size_t kDenoiseFeatures = 7;

struct DenoiseInput {
  int width = 0;
  int height = 0;
  std::array<std::vector<Rgb>, kHalfBuffers> half_buffers;        // means, linear radiance, row by row
  std::array<std::vector<float>, kDenoiseFeatures> features;  // each with one value per pixel, of the order of 1
};

// Features from layers with three, three and one value per pixel; the depth is divided by its maximum.
std::array<std::vector<float>, kDenoiseFeatures> denoise_features(std::span<const float> albedo,
                                                                  std::span<const float> normal,
                                                                  std::span<const float> depth);

// The half-buffers of a film. Pixels that lack samples of one half-buffer have the mean of the other one.
DenoiseInput denoise_input(const Film& film, std::array<std::vector<float>, kDenoiseFeatures> features);

class Denoiser {
 public:
  explicit Denoiser(DenoiseInput input);

  // Filters the rows [first, end) into `output`, which holds the whole image. Different rows may be filtered by
  // different threads; the result does not depend on the division into calls. Values that are not finite count as
  // missing; a pixel without valid neighbours is black.
  void filter_rows(int first, int end, std::span<Rgb> output) const;

  int width() const { return input_.width; }
  int height() const { return input_.height; }

 private:
  struct RowBuffers;

  void compute_weights(int y, size_t guide, int dx, int dy, RowBuffers& buffers) const;
  void filter_row(int y, size_t half_buffer, RowBuffers& buffers, std::span<Rgb> row) const;

  DenoiseInput input_;
  std::vector<uint8_t> valid_;
  std::vector<float> variance_;  // of a half-buffer, mean of the channels, smoothed
};

}  // namespace etendue::film
