// Cameras that see illuminated surfaces: views of the whole scene, and the camera to which a view is reset.
#pragma once
#include <span>

#include "base/vec.h"
#include "camera/camera.h"
#include "scene/forward.h"

namespace etendue::render {
struct Document;
}

namespace etendue::viewer {

// What a camera sees, as shares of the image.
struct SeenSurfaces {
  float all = 0;
  float lit = 0;  // light reaches them, directly or by diffuse reflections

  // Whether the image shows more than a few surfaces, most of which are not black.
  bool suffice() const { return all > 0.03f && lit > 0.5f * all; }
};

// Traces a fixed set of a few hundred paths. Materials are taken as diffuse.
SeenSurfaces seen_surfaces(const scene::CompiledScene& scene, Camera camera, float aspect);

// The camera, unless it sees too little: then one that sees the whole scene from another side, or, if walls hide the
// light from there, from inside. The given camera if no view of the scene is better.
Camera lit_camera(const scene::CompiledScene& scene, const Camera& camera, float aspect);

// The first camera of the opened file that sees enough; otherwise a lit view of the whole scene.
Camera reset_camera(const render::Document& document, const scene::CompiledScene& scene);

}  // namespace etendue::viewer
