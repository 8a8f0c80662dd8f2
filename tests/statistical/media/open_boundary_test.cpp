// Media behind a boundary that is not closed.
//
// Means are compared within 4.5 standard errors, which are bounded: one false alarm in 150,000 comparisons of normal
// means.
#include <gtest/gtest.h>

#include "film/film_mean.h"
#include "statistical/media/expected_radiance.h"
#include "support/integrator_scenes.h"
#include "support/scattering_scenes.h"

namespace etendue {
namespace {

// A box without the two triangles of its first face.
std::shared_ptr<const Mesh> open_box() {
  Mesh mesh = *scene::box(Vec3(1));
  mesh.triangles.erase(mesh.triangles.begin(), mesh.triangles.begin() + 2);
  return std::make_shared<const Mesh>(std::move(mesh));
}

render::Document white_furnace(std::shared_ptr<const Mesh> boundary) {
  scene::Scene scene;
  scene.environment.tint = Rgb(1);
  add(scene, std::move(boundary), test::medium_boundary(test::medium(Rgb(3), Rgb(0))));
  return test::document(std::move(scene), look_at({3, 3.5f, 4}, {0, 0, 0}, {0, 1, 0}, 0.7f), 16, 16);
}

// A medium that does not absorb is invisible in a uniform environment, wherever it ends.
TEST(OpenBoundary, MediaEndAtTheBoundsOfTheSolid) {
  for (const auto& boundary : {open_box(), test::quad(1)})
    for (const char* name : {"path", "path-pure", "distribution"})
      test::expect_radiance(test::with_integrator(white_furnace(boundary), name), 64, Rgb(1), 0.01, name);
}

// Paths from lights enter through a gap without noticing the medium. They end nevertheless.
TEST(OpenBoundary, PathsFromBothEndsStayShort) {
  for (const auto& boundary : {open_box(), test::quad(1)}) {
    const film::Film film = test::rendered(test::with_integrator(white_furnace(boundary), "bdpt"), 16);
    const double mean = film::mean_of(film).value;
    EXPECT_GT(mean, 0.8);
    EXPECT_LT(mean, 1.2);
  }
}

}  // namespace
}  // namespace etendue
