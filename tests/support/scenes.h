// Small scenes with answers in closed form, and the shortest way to render one.
#pragma once
#include <functional>
#include <memory>
#include <string>

#include "film/film.h"
#include "render/document.h"
#include "scene/scene.h"

namespace etendue::test {

// A Lambertian material without a specular layer.
Material diffuse(const Rgb& albedo, const Rgb& emission = Rgb(0));

std::shared_ptr<const Mesh> cube(float half_size, bool inwards);
std::shared_ptr<const Mesh> quad(float half_size);             // in the xz plane, facing +y
std::shared_ptr<const Mesh> disk(float radius, int segments);  // in the xz plane, facing +y
std::shared_ptr<const Mesh> sphere(float radius, int rings, bool inwards);

// Puts a mesh with a material of its own into the scene; returns the node.
int add(scene::Scene& scene, std::shared_ptr<const Mesh> mesh, const Material& material,
        const Mat4& transform = Mat4(1));

// A closed cube of one diffuse material that emits radiance one: L = 1 / (1 - albedo) everywhere.
scene::Scene furnace(float albedo);

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
