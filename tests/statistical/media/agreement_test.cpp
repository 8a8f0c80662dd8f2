// Integrators with scattering media agree with each other; images do not depend on threads; extreme media are finite.
#include <gtest/gtest.h>

#include <cmath>

#include "support/integrator_scenes.h"
#include "support/scattering_scenes.h"

namespace etendue {
namespace {

using render::Document;
using test::medium;
using test::medium_boundary;
using test::with;
using test::with_integrator;

struct Place {
  const char* name;
  Document document;
  uint32_t samples;  // of path; path-pure takes four times as many
};

std::vector<Place> places() {
  return {{"fog in the Cornell box", test::foggy_cornell_box(), 96},
          {"glass of milk", test::glass_of_milk(), 64},
          {"stone in murky water", test::stone_in_murky_water(), 64},
          {"camera in fog", test::camera_in_fog(), 64}};
}

// t-tests over blocks; 1 % false alarms over all scenes.
TEST(Agreement, OfPathTracingWithAndWithoutLightSamples) {
  const std::vector<Place> all = places();
  for (const Place& place : all)
    test::expect_agreement(test::replicated(with_integrator(place.document, "path"), place.samples, 1000),
                           test::replicated(with_integrator(place.document, "path-pure"), 4 * place.samples, 2000),
                           place.name, static_cast<int>(all.size()));
}

// Every strategy of light sampling under a spot light.
TEST(Agreement, OfLightStrategiesUnderASpotLight) {
  const Document d = test::spot_light_in_fog();
  const auto every = test::replicated(with(d, "path.lights", "every"), 64, 1000);
  for (const char* strategy : {"one", "tree"})
    test::expect_agreement(every, test::replicated(with(d, "path.lights", strategy), 64, 2000), strategy, 2);
}

// The path classes of a scene partition its image, sample by sample.
TEST(PathClasses, SumToTheImage) {
  for (const Place& place : places()) {
    const film::Film whole = test::rendered(place.document, 8);
    std::vector<film::Film> parts;
    for (const char* paths : {"EL", "E(D|G|S)+L", "E(D|G|S)*V(D|G|S)*L", "E(D|G|S)*V.*V.*L"})
      parts.push_back(test::rendered(with(place.document, "film.paths", paths), 8));
    for (int y = 0; y < whole.height(); ++y)
      for (int x = 0; x < whole.width(); ++x) {
        Rgb sum(0);
        for (const film::Film& part : parts) sum += part.mean(x, y);
        for (int c = 0; c < 3; ++c)
          ASSERT_NEAR(sum[c], whole.mean(x, y)[c], 1e-4f * whole.mean(x, y)[c] + 1e-6f) << place.name;
      }
    EXPECT_GT(test::mean_of(parts[2]).value, 0) << place.name;
    EXPECT_GT(test::mean_of(parts[3]).value, 0) << place.name;
  }
}

TEST(Threads, DoNotChangeTheImage) {
  for (const char* name : {"path", "path-pure"})
    for (Document d : {test::camera_in_fog(), test::glass_of_milk()}) {
      d = with_integrator(d, name);
      const film::Film one = test::rendered(d, 4, 1);
      EXPECT_TRUE(test::same_bits(one, test::rendered(d, 4, 2))) << name;
      EXPECT_TRUE(test::same_bits(one, test::rendered(d, 4, 7))) << name;
    }
}

// The model with scattering media renders scenes without them as the other models do.
TEST(Boundary, WithoutAMediumIsInvisible) {
  const Document plain = test::balls_under_area_light();
  auto scene = std::make_shared<scene::Scene>(*plain.scene);
  add(*scene, test::sphere(0.8f, 16, false), medium_boundary({}));
  Document bounded = plain;
  bounded.scene = scene;
  for (const char* name : {"path", "path-pure", "bdpt"})
    test::expect_agreement(test::replicated(with_integrator(plain, name), 64, 1000),
                           test::replicated(with_integrator(bounded, name), 64, 2000), name, 3);
}

// ---- Extreme media.

void expect_finite(const Document& d, const std::string& what) {
  for (const char* name : {"path", "path-pure"}) {
    const film::Film film = test::rendered(with_integrator(d, name), 8);
    EXPECT_EQ(film.invalid_samples().total(), 0U) << what << ' ' << name;
    EXPECT_TRUE(std::isfinite(test::mean_of(film).value)) << what << ' ' << name;
  }
}

TEST(ExtremeMedia, AreFinite) {
  const auto ball_of = [](const MediumDescription& m) {
    scene::Scene scene;
    add(scene, test::sphere(1, 16, false), medium_boundary(m));
    add(scene, test::quad(3), test::diffuse(Rgb(0.5f)), Mat4(1));
    scene.environment.tint = Rgb(1);
    return test::document(std::move(scene), look_at({0, 1, 3}, Vec3(0), {0, 1, 0}, 0.8f), 16, 16);
  };
  for (const float g : {-1.0f, -0.999f, 0.999f, 1.0f}) expect_finite(ball_of(medium(Rgb(3), Rgb(0), g)), "g");
  expect_finite(ball_of(medium(Rgb(0), Rgb(100))), "absorption of optical depth 100");
  expect_finite(ball_of(medium(Rgb(50), Rgb(50))), "optical depth 100");
  expect_finite(ball_of(medium({1e6f, 1, 0}, {0, 0, 1e6f})), "coefficients from 0 to 1e6");
  expect_finite(ball_of(medium({1e-30f, 0, 0})), "tiny coefficients");
}

}  // namespace
}  // namespace etendue
