// Adjustments of a scene that has just been opened to what its camera sees: focus, near plane and exposure. They belong
// to opening the file, so they are not steps of undo. The exposure is adjusted again when the user selects another
// environment, as a part of that step.
#pragma once
#include <cstdint>

#include "scene/forward.h"

namespace etendue {
struct Camera;
}
namespace etendue::render {
struct Document;
}

namespace etendue::viewer {

struct AppState;

// What is still to be adjusted.
enum class FirstView : uint8_t { adjusted, camera_pending, exposure_pending, environment_selected };

// The document's camera, focused on the surface in the centre of the image if it is a pinhole without a stated focus,
// and without its near plane if that hides no surface.
Camera camera_for_navigation(const render::Document& document, const scene::CompiledScene& scene);

// Applies camera_for_navigation as soon as the scene is compiled. As soon as there are enough samples, adds the studio
// environment if the lights of the file leave most surfaces black, and sets an exposure if the image would be dark or
// clipped. Edits of the user end the adjustments; another environment begins that of the
// exposure. To be called for each frame.
void adjust_first_view(AppState& state);

}  // namespace etendue::viewer
