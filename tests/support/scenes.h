// Small scenes with answers in closed form, and the shortest way to render one.
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

// A scene as a document with a camera.
render::Document document(scene::Scene scene, const Camera& camera, int width, int height);

// The golden sphere (scene/integrating_sphere.h): a square picture of its wall with random numbers. No roulette: walks
// end where less than a millionth is missing.
render::Document integrating_sphere(double share, float albedo, scene::Cap cap = scene::Cap::reflecting, int size = 64);

// The built-in box as a square picture.
render::Document cornell(int size);

using film::Mean;
using film::mean_of;
using render::rendered;

Rgb mean_color(const film::Film& film);

// The same picture to the last bit.
bool same_bits(const film::Film& a, const film::Film& b);

// The folder of the real data, or empty.
std::string data_folder();

}  // namespace etendue::test
