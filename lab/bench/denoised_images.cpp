#include "bench/denoised_images.h"

#include <chrono>

namespace etendue::bench {
namespace {

constexpr uint32_t kFeatureSamples = 4;  // per pixel and half-buffer

using Clock = std::chrono::steady_clock;

double seconds_between(Clock::time_point start, Clock::time_point end) {
  return std::chrono::duration<double>(end - start).count();
}

}  // namespace

Result<std::vector<float>> DenoisedImages::of(const scene::CompiledScene& scene, const film::Film& film,
                                              const std::function<bool()>& continues) {
  if (!features_) {
    const auto start = Clock::now();
    features_ = render::denoise_features(scene, document_, kFeatureSamples, threads_);
    feature_seconds_ = seconds_between(start, Clock::now());
  }
  const auto start = Clock::now();
  auto image = render::denoised_image(film, *features_, denoiser_, threads_, continues);
  if (!image) return image.error();
  if (!image->pixels.empty()) filter_seconds_ = seconds_between(start, Clock::now());
  return std::move(image->pixels);
}

}  // namespace etendue::bench
