// Small scenes with closed-form solutions, and helpers to render them.
#pragma once
#include <functional>
#include <memory>
#include <string>

#include "film/film_mean.h"
#include "render/session.h"
#include "scene/builtin/integrating_sphere.h"
#include "scene/builtin/shapes.h"

namespace etendue::test {

using scene::add;
using scene::add_point_light;
using scene::cube;
using scene::diffuse;
using scene::disk;
using scene::furnace;
using scene::quad;
using scene::sphere;

// A document of a scene and a camera.
render::Document document(scene::Scene scene, const Camera& camera, int width, int height);

// The integrating sphere (scene/builtin/integrating_sphere.h): a square image of its wall with random numbers. There is
// no Russian roulette. Paths end at the depth where less than a millionth of the radiance is missing.
render::Document integrating_sphere(double share, float albedo, scene::Cap cap = scene::Cap::reflecting, int size = 64);

// The built-in Cornell box as a square image.
render::Document cornell(int size);

using film::Mean;
using film::mean_of;
using render::rendered;

// The document with "NAME=VALUE" set for every material, e.g. "layering=energy-conserving".
Result<render::Document> with_materials_set(render::Document document, const std::string& setting);

Rgb mean_color(const film::Film& film);

// True if the sums of all pixels are bit-identical.
bool same_bits(const film::Film& a, const film::Film& b);

// The folder of the test data (ETENDUE_TEST_DATA), or an empty string.
std::string data_folder();

}  // namespace etendue::test
