#include "render/denoised_image.h"

#include <algorithm>

#include "render/aov.h"
#include "render/thread_pool.h"

namespace etendue::render {

DenoiseFeatures denoise_features(const scene::CompiledScene& scene, const Document& document, uint32_t samples,
                                 int threads) {
  const auto layers = render_aov_half_buffers(scene, document, {"albedo", "shading-normal", "depth"}, samples, threads);
  float max_depth = 0;
  for (const auto& half_buffer : layers)
    for (const float depth : half_buffer[2].pixels) max_depth = std::max(max_depth, depth);
  DenoiseFeatures features;
  for (size_t h = 0; h < features.size(); ++h)
    features[h] = film::feature_planes(layers[h][0].pixels, layers[h][1].pixels, layers[h][2].pixels,
                                       max_depth > 0 ? 1 / max_depth : 0);
  return features;
}

std::vector<float> denoised_image(const film::Film& film, DenoiseFeatures features, int threads,
                                  const std::function<bool()>& continues) {
  const film::DenoiseInput input{.width = film.width(),
                                 .height = film.height(),
                                 .half_buffers = film::half_buffer_means(film),
                                 .features = std::move(features)};
  ThreadPool workers(threads);
  const std::vector<Rgb> pixels = film::denoise(
      input, [&](int count, const std::function<void(int)>& task) { workers.run(0, count, task, continues); });
  std::vector<float> image;
  if (!continues()) return image;
  image.reserve(3 * pixels.size());
  for (const Rgb& pixel : pixels) image.insert(image.end(), {pixel.r, pixel.g, pixel.b});
  return image;
}

}  // namespace etendue::render
