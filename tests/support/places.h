// Scenes that take everything apart that could be wrong with a method that walks from the lights: kinds of lights,
// smooth and rough glass, absorption, shading normals, the lens.
#pragma once
#include "support/replicates.h"

namespace etendue::test {

// With a setting by name; it must be one.
render::Document with(const render::Document& d, const char* name, const std::string& value);
render::Document by(const render::Document& d, const std::string& integrator);
// What light tracing can find.
render::Document without_mirrors_in_view(const render::Document& d);

// A floor, a smooth-shaded ball, one of glass that absorbs and one of clay, and room for lights.
scene::Scene balls();
// From above, kSize squared.
render::Document seen(scene::Scene scene);
render::Document under_a_lamp();
render::Document under_a_sky();
render::Document under(const char* light_type);
// A quad, a disk and a sphere that shine.
render::Document under_surface_lights();
// Reflection models, reciprocal and not, brushed, layered, measured, rough glass, in a room with a lamp.
render::Document modelled_things();
render::Document through_a_lens(const render::Document& d);

// Expects the methods of both to agree (expect_agreement).
void expect_same(const render::Document& a, uint32_t samples_a, const render::Document& b, uint32_t samples_b,
                 const std::string& what, int comparisons);

}  // namespace etendue::test
