// Denoised images of renderings (film/denoise/denoise.h), for display only
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "base/parameter.h"
#include "base/result.h"
#include "film/denoise/denoise.h"
#include "film/film.h"
#include "render/document.h"
#include "scene/forward.h"

namespace etendue::render {

enum class Denoiser : uint8_t { automatic, regression, open_image_denoise };

// Samples of the features, per pixel and half-buffer, where an image is shown or measured.
inline constexpr uint32_t kDenoiseFeatureSamples = 4;

using DenoiseFeatures = std::array<film::FeaturePlanes, film::kHalfBuffers>;

// Albedo, shading normal and depth of the first hits of `samples` camera rays per pixel and half-buffer. They do not
// depend on the film. With 0 threads: one per hardware thread.
DenoiseFeatures denoise_features(const scene::CompiledScene& scene, const Document& document, uint32_t samples,
                                 int threads);

// "regression", and for people "Regression".
const char* name_of(Denoiser denoiser);
const char* label_of(Denoiser denoiser);
// The denoiser of this name. Usage errors: there is none, or it is Open Image Denoise and not installed.
Result<Denoiser> denoiser_named(const std::string& name);

struct DenoisedImage {
  std::vector<float> pixels;                 // linear radiance, three numbers per pixel
  Denoiser denoiser = Denoiser::regression;  // that was used
};

// `automatic` is Open Image Denoise (film/denoise/open_image_denoise.h) if it is installed and works, else regression.
// Regression gives the same bits for any number of threads. No pixels if `continues`, which any thread may call, returns
// false. Errors: those of Open Image Denoise if it was asked for.
Result<DenoisedImage> denoised_image(
    const film::Film& film, DenoiseFeatures features, Denoiser denoiser, int threads,
    const std::function<bool()>& continues = [] { return true; });

}  // namespace etendue::render

namespace etendue {

template <>
struct Options<render::Denoiser> {
  static constexpr std::array<Option, 3> kOptions{
      {{"auto", "Automatic"}, {"regression", "Regression"}, {"oidn", "Open Image Denoise"}}};
};

}  // namespace etendue
