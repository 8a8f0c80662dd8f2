// Test scenes for light path integrators. They cover the kinds of lights, smooth and rough glass, absorption, shading
// normals and the lens.
#pragma once
#include "support/independent_estimates.h"

namespace etendue::test {

// Sets a parameter by name. The name and the value must be valid.
render::Document with(const render::Document& d, const char* name, const std::string& value);
// Selects the integrator by name.
render::Document with_integrator(const render::Document& d, const std::string& integrator);
// Restricts the paths to those that light tracing can sample: the first hit is not specular.
render::Document without_specular_first_hit(const render::Document& d);

// A floor, a smooth-shaded diffuse ball, a ball of absorbing glass and a ball of clay, without lights.
scene::Scene balls();
// A document of kSize x kSize pixels that shows the scene from above.
render::Document view_from_above(scene::Scene scene);
render::Document balls_under_area_light();
render::Document balls_under_sky();
// The physical sky with its sun, at a luminance of the order of one.
render::Document balls_under_sun();
render::Document balls_under_light(const char* light_type);
// Analytic area lights: a quad, a disk, a sphere and a cylinder.
render::Document balls_under_analytic_lights();
// Reflection models in a scene with a quad light: reciprocal and non-reciprocal, anisotropic, layered, measured, and
// rough glass.
render::Document bsdf_model_scene();
// A room under a bright sky, seen from inside, with a hole in its ceiling and a slit in a wall. `portal` marks the hole.
render::Document room_with_two_windows(bool portal);
render::Document with_lens(const render::Document& d);

// Expects equal means of both documents (expect_agreement).
void expect_same_mean(const render::Document& a, uint32_t samples_a, const render::Document& b, uint32_t samples_b,
                      const std::string& what, int comparisons);

}  // namespace etendue::test
