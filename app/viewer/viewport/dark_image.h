// Notices when there is next to nothing to see: surfaces that no light reaches, or no surfaces.
#pragma once
#include <cstdint>
#include <span>

#include "scene/forward.h"

namespace etendue::render {
struct Document;
struct Frame;
}  // namespace etendue::render

namespace etendue::viewer {

enum class Darkness : uint8_t { none, surfaces_are_black, no_surfaces };

// Looks at a grid of pixels through a pinhole. Unknown, and therefore none, for previews and images of a few samples.
Darkness find_darkness(const render::Document& document, const scene::CompiledScene& scene, const render::Frame& frame);

// The exposure in EV below which most of these surfaces are black. The luminances are in ascending order. Infinite if most
// are black at any exposure, minus infinity if there are none.
float lowest_exposure(std::span<const float> luminances);

}  // namespace etendue::viewer
