// What lies under each pixel, beside its radiance: averages over the first samples of the pixel, from the same camera
// rays.
#pragma once
#include <string>
#include <vector>

#include "image/image.h"
#include "render/document.h"
#include "scene/forward.h"

namespace etendue::render {

// albedo, shading-normal, geometric-normal, depth, position, material-id, object-id.
const std::vector<std::string>& aov_names();

// One layer per name; `samples` camera rays per pixel (ids come from the first). Depth is the distance along the ray, 0
// where nothing was hit. Uses all threads of the caller's machine; `cancel` may stop it early.
std::vector<image::Layer> render_aovs(const scene::CompiledScene& scene, const Document& document,
                                      const std::vector<std::string>& names, uint32_t samples, int threads);

}  // namespace etendue::render
