// Arbitrary output variables: properties of the first hit of each pixel, from the camera rays of its first samples.
#pragma once
#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "film/half_buffers.h"
#include "image/image.h"
#include "render/document.h"
#include "scene/forward.h"

namespace etendue::render {

// The names of the AOVs of first hits: albedo, shading-normal, geometric-normal, depth, position, material-id,
// object-id.
const std::vector<std::string>& aov_names();

// The names of the terms of the equation of transfer (integrator/path/transport_terms.h): medium-surface,
// medium-absorption, medium-out-scattering, medium-emission, medium-in-scattering.
const std::vector<std::string>& medium_aov_names();

// One layer per known name; unknown names are ignored. Values are means over `samples` camera rays per pixel, except
// for ids, which come from the first ray. Normals face the camera. Depth is the distance along the ray in metres. Ids
// start at 1. All values are 0 where a ray hits nothing. With 0 threads: one per hardware thread.
std::vector<image::Layer> render_aovs(const scene::CompiledScene& scene, const Document& document,
                                      const std::vector<std::string>& names, uint32_t samples, int threads);

// The same, separately from the camera rays of the samples of both half-buffers: `samples` rays in each of them.
std::array<std::vector<image::Layer>, film::kHalfBuffers> render_aov_half_buffers(const scene::CompiledScene& scene,
                                                                                  const Document& document,
                                                                                  const std::vector<std::string>& names,
                                                                                  uint32_t samples, int threads);

// The terms of the equation of transfer among these names, in the order of medium_aov_names(): radiance in cd/m^2,
// estimated without bias by path tracing with `samples` paths per pixel and the maximum path length of the document's
// integrator. No layers if `continues`, which is called between blocks of pixels, returns false.
std::vector<image::Layer> render_medium_aovs(
    std::shared_ptr<const scene::CompiledScene> scene, const Document& document, const std::vector<std::string>& names,
    uint32_t samples, int threads, const std::function<bool()>& continues = [] { return true; });

}  // namespace etendue::render
