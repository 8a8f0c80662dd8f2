#include "bench/denoised_images.h"

#include "render/clock.h"

namespace etendue::bench {

Result<std::vector<float>> DenoisedImages::of(const scene::CompiledScene& scene, const film::Film& film,
                                              const std::function<bool()>& continues) {
  if (!features_) {
    const auto start = render::Clock::now();
    features_ = render::denoise_features(scene, document_, render::kDenoiseFeatureSamples, threads_);
    feature_seconds_ = render::seconds_since(start);
  }
  const auto start = render::Clock::now();
  auto image = render::denoised_image(film, *features_, denoiser_, threads_, continues);
  if (!image) return image.error();
  if (!image->pixels.empty()) filter_seconds_ = render::seconds_since(start);
  return std::move(image->pixels);
}

}  // namespace etendue::bench
