// Small scenes with answers in closed form, and the shortest way to render one.
#pragma once
#include <functional>
#include <memory>
#include <string>

#include "film/film.h"
#include "render/document.h"
#include "scene/shapes.h"

namespace etendue::test {

using scene::add;
using scene::cube;
using scene::diffuse;
using scene::disk;
using scene::furnace;
using scene::quad;
using scene::sphere;

// A scene as a document with a camera.
render::Document document(scene::Scene scene, const Camera& camera, int width, int height);

// Renders to the end on this many threads.
film::Film rendered(const render::Document& document, uint32_t samples, int threads = 0);

// Mean over pixels of the film's luminance-free average channel, and its standard error from the pixels' spread.
struct Mean {
  double value, standard_error;
};
Mean mean_of(const film::Film& film);
Rgb mean_color(const film::Film& film);

// The folder of the real data, or empty.
std::string data_folder();

}  // namespace etendue::test
