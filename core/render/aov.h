// Arbitrary output variables: properties of the first hit of each pixel, from the camera rays of its first samples.
#pragma once
#include <string>
#include <vector>

#include "image/image.h"
#include "render/document.h"
#include "scene/forward.h"

namespace etendue::render {

// The names of all AOVs: albedo, shading-normal, geometric-normal, depth, position, material-id, object-id.
const std::vector<std::string>& aov_names();

// One layer per known name; unknown names are ignored. Values are means over `samples` camera rays per pixel, except
// for ids, which come from the first ray. Normals face the camera. Depth is the distance along the ray in metres. Ids
// start at 1. All values are 0 where a ray hits nothing. With 0 threads: one per hardware thread.
std::vector<image::Layer> render_aovs(const scene::CompiledScene& scene, const Document& document,
                                      const std::vector<std::string>& names, uint32_t samples, int threads);

}  // namespace etendue::render
