#include "render/denoised_image.h"

#include <algorithm>

#include "film/denoise/open_image_denoise.h"
#include "render/aov.h"
#include "render/thread_pool.h"

namespace etendue::render {
namespace {

std::vector<float> channels_of(const std::vector<Rgb>& pixels) {
  std::vector<float> values;
  values.reserve(3 * pixels.size());
  for (const Rgb& pixel : pixels) values.insert(values.end(), {pixel.r, pixel.g, pixel.b});
  return values;
}

const Option& option_of(Denoiser denoiser) { return Options<Denoiser>::kOptions[static_cast<size_t>(denoiser)]; }

}  // namespace

const char* name_of(Denoiser denoiser) { return option_of(denoiser).name; }
const char* label_of(Denoiser denoiser) { return option_of(denoiser).label; }

Result<Denoiser> denoiser_named(const std::string& name) {
  std::string names;
  for (const Denoiser denoiser : {Denoiser::automatic, Denoiser::regression, Denoiser::open_image_denoise}) {
    names += (names.empty() ? "" : ", ") + std::string(name_of(denoiser));
    if (name != name_of(denoiser)) continue;
    if (denoiser == Denoiser::open_image_denoise)
      if (const auto found = film::find_open_image_denoise(); !found) return found.error();
    return denoiser;
  }
  return usage_error("there is no denoiser '" + name + "'; give one of " + names);
}

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

Result<DenoisedImage> denoised_image(const film::Film& film, DenoiseFeatures features, Denoiser denoiser, int threads,
                                     const std::function<bool()>& continues) {
  const film::DenoiseInput input{.width = film.width(),
                                 .height = film.height(),
                                 .half_buffers = film::half_buffer_means(film),
                                 .features = std::move(features)};
  if (denoiser != Denoiser::regression) {
    const auto pixels = film::denoise_with_open_image_denoise(input, threads, continues);
    if (pixels) return DenoisedImage{.pixels = channels_of(*pixels), .denoiser = Denoiser::open_image_denoise};
    if (denoiser == Denoiser::open_image_denoise) return pixels.error();
  }
  ThreadPool workers(threads);
  const std::vector<Rgb> pixels = film::denoise(
      input, [&](int count, const std::function<void(int)>& task) { workers.run(0, count, task, continues); });
  if (!continues()) return DenoisedImage{};
  return DenoisedImage{.pixels = channels_of(pixels), .denoiser = Denoiser::regression};
}

}  // namespace etendue::render
