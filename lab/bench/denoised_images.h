// Denoised images of a method (render/denoised_image.h) and the time that they take. Errors of a method with the setting
// denoise (method_spec.h) are measured on them.
#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "render/denoised_image.h"

namespace etendue::bench {

// The first number of samples at which they are measured: one per half-buffer, because their difference is the noise.
inline constexpr uint32_t kFirstDenoisedSamples = film::kHalfBuffers;

class DenoisedImages {
 public:
  // With 0 threads: one per hardware thread.
  DenoisedImages(const render::Document& document, render::Denoiser denoiser, int threads)
      : document_(document), denoiser_(denoiser), threads_(threads) {}

  // Three numbers per pixel. The first call renders the features of the scene, which all later ones share. Empty if
  // `continues` returns false, which any thread may call. Errors: those of Open Image Denoise.
  Result<std::vector<float>> of(const scene::CompiledScene& scene, const film::Film& film,
                                const std::function<bool()>& continues);
  // What the latest image took, with its features.
  double seconds() const { return feature_seconds_ + filter_seconds_; }

 private:
  render::Document document_;
  render::Denoiser denoiser_;
  int threads_;
  std::optional<render::DenoiseFeatures> features_;
  double feature_seconds_ = 0, filter_seconds_ = 0;
};

}  // namespace etendue::bench
