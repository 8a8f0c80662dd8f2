// Denoised images of renderings (film/denoise/denoise.h), for display only
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "film/denoise/denoise.h"
#include "film/film.h"
#include "render/document.h"
#include "scene/forward.h"

namespace etendue::render {

using DenoiseFeatures = std::array<film::FeaturePlanes, film::kHalfBuffers>;

// Albedo, shading normal and depth of the first hits of `samples` camera rays per pixel and half-buffer. They do not
// depend on the film. With 0 threads: one per hardware thread.
DenoiseFeatures denoise_features(const scene::CompiledScene& scene, const Document& document, uint32_t samples,
                                 int threads);

// Linear radiance, three numbers per pixel. The same bits for any number of threads. Empty if `continues`, which is
// called between tiles, returns false.
std::vector<float> denoised_image(
    const film::Film& film, DenoiseFeatures features, int threads,
    const std::function<bool()>& continues = [] { return true; });

}  // namespace etendue::render
