// The integrator that measures path classes and tests certificates, and reduced images rendered with it.
#pragma once
#include "render/document.h"
#include "scene/forward.h"

namespace etendue::advisor {

// The image of the document (scene, camera, size, filter, path expression, colour) rendered by path tracing with Sobol' points
// and default settings, without limits: unbiased and, except for caustics of point lights, complete.
render::Document with_reference_integrator(const render::Document& document);
// The same, but by bidirectional path tracing if the scene has both point, spot or directional lights and specular
// surfaces, and this integrator supports it: it finds caustics of such lights on surfaces that the camera sees directly.
render::Document with_reference_integrator(const render::Document& document, const scene::CompiledScene& scene);

// The same image with both sides divided by `divisor`, but with a shorter side of at least `min_side` pixels. Images
// are never enlarged.
render::Document reduced_by(const render::Document& document, int divisor, int min_side);

// The same image with at most `max_pixels` pixels and the same aspect ratio.
render::Document limited_to(const render::Document& document, int max_pixels);

}  // namespace etendue::advisor
