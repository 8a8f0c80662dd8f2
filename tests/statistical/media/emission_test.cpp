// Light of media that emit: direction samples towards them against closed forms and against paths that find them by
// chance, and the terms of the equation of transfer.
//
// Means are compared within 4.5 standard errors, which are bounded: one false alarm in 150,000 comparisons of normal
// means.
#include <gtest/gtest.h>

#include <cmath>

#include "render/aov.h"
#include "statistical/media/class_sums.h"
#include "statistical/media/expected_radiance.h"
#include "support/integrator_scenes.h"
#include "support/scattering_scenes.h"
#include "support/translation.h"

namespace etendue::media_emission {
namespace {

using render::Document;
using test::at;
using test::expect_radiance;
using test::medium;
using test::medium_boundary;
using test::with;
using test::with_integrator;

MediumDescription emitting_medium(const Rgb& scattering, const Rgb& absorption, const Rgb& emission,
                                  const char* density = "") {
  MediumDescription m = medium(scattering, absorption, 0.3f);
  m.emission = emission;
  if (*density) m.density.field = make_density(density);
  return m;
}

// A camera whose pixels all see the same point of the floor.
Document view_of_floor(scene::Scene scene, const Vec3& point) {
  return test::document(std::move(scene), look_at(point + Vec3(0.5f, 2, 6), point, {0, 1, 0}, 1e-4f), 16, 16);
}

// A white floor under a ball of gas of radius 0.5 at a height of 2 m; nothing else emits.
scene::Scene gas_above_floor(const MediumDescription& gas) {
  scene::Scene scene;
  add(scene, test::quad(8), test::diffuse(Rgb(1)));
  add(scene, test::sphere(0.5f, 96, false), medium_boundary(gas), at({0, 2, 0}));
  return scene;
}

// The radiance of the floor below a ball of gas that only absorbs: the integral over the directions to the ball of
// L_e (1 - exp(-sigma_a chord)) cos / pi.
double radiance_below_gas(double absorption, double emission) {
  constexpr int kSteps = 4000;
  constexpr double kRadius = 0.5, kDistance = 2;
  const double largest = std::asin(kRadius / kDistance);
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double angle = (i + 0.5) / kSteps * largest, off_axis = kDistance * std::sin(angle);
    const double chord = 2 * std::sqrt(kRadius * kRadius - off_axis * off_axis);
    sum += -std::expm1(-absorption * chord) * std::cos(angle) * std::sin(angle) * largest / kSteps;
  }
  return 2 * emission * sum;
}

TEST(MediumLight, IrradianceBelowABallOfGas) {
  const Rgb absorption(0.1f, 1, 8), emission(10, 5, 2);
  Rgb expected;
  for (int c = 0; c < 3; ++c)
    expected[c] =
        static_cast<float>(radiance_below_gas(static_cast<double>(absorption[c]), static_cast<double>(emission[c])));
  const Document d = view_of_floor(gas_above_floor(emitting_medium(Rgb(0), absorption, emission)), Vec3(0));
  for (const char* name : {"path", "distribution"})
    expect_radiance(with(with_integrator(d, name), (std::string(name) + ".max-depth").c_str(), "2"), 256, expected,
                    0.003, name);
  expect_radiance(with(with_integrator(d, "path-pure"), "path-pure.max-depth", "2"), 4096, expected, 0.02, "path-pure");
}

// The scenes are lit by media alone: a flame, a ball of gas that scatters, two media at once, and a flame inside fog.
std::vector<std::pair<const char*, Document>> fires() {
  MediumDescription flame = emitting_medium(Rgb(0.5f), Rgb(3), Rgb(20), "flame");
  flame.temperature = 2200;
  std::vector<std::pair<const char*, Document>> places;
  for (const char* name : {"flame", "gas", "two media", "flame in fog"}) {
    const std::string place = name;
    scene::Scene scene = test::balls();
    if (place != "gas") add(scene, scene::box({0.4f, 0.7f, 0.4f}), medium_boundary(flame), at({0.2f, 1.4f, 0}));
    if (place == "gas" || place == "two media")
      add(scene, test::sphere(0.4f, 24, false), medium_boundary(emitting_medium({2, 1, 0.5f}, Rgb(0.5f), {8, 6, 3})),
          at({-1, 1.6f, 0.3f}));
    if (place == "flame in fog") {
      scene.atmosphere.medium = medium({0.1f, 0.15f, 0.2f}, Rgb(0.02f), 0.5f);
      scene.atmosphere.radius = 8;
    }
    places.emplace_back(name, test::view_from_above(std::move(scene)));
  }
  return places;
}

TEST(MediumLight, IntegratorsAgree) {
  for (const auto& [name, d] : fires()) {
    const auto path = test::replicated(with_integrator(d, "path"), 24, 1000);
    test::expect_agreement(path, test::replicated(with_integrator(d, "path-pure"), 96, 2000),
                           std::string(name) + ", path-pure", 8);
    test::expect_agreement(
        path, test::replicated(with(with_integrator(d, "distribution"), "distribution.branches-2", "2"), 8, 3000),
        std::string(name) + ", distribution", 8);
  }
}

// In bidirectional path tracing, light samples and chance replace each other.
TEST(MediumLight, BidirectionalTechniques) {
  const Document d = fires()[1].second;
  const auto path = test::replicated(with_integrator(d, "path"), 48, 1000);
  const Document bdpt = with_integrator(d, "bdpt");
  test::expect_agreement(path, test::replicated(bdpt, 24, 2000), "bdpt", 4);
  test::expect_agreement(path, test::replicated(with(bdpt, "bdpt.without", "1,*"), 96, 3000), "without samples", 4);
  test::expect_agreement(path, test::replicated(with(bdpt, "bdpt.reuse", "false"), 128, 4000), "without reuse", 4);
  // Light that is seen directly or by specular scattering is found by chance only.
  const Document indirect = with(d, "film.paths", "E.*(D|G|V)L");
  test::expect_agreement(test::replicated(with_integrator(indirect, "path"), 48, 5000),
                         test::replicated(with(with_integrator(indirect, "bdpt"), "bdpt.without", "0,*"), 64, 6000),
                         "without chance", 4);
}

// The mean variance of the blocks of an image.
double mean_variance(const test::Estimate& e) {
  double sum = 0;
  for (const double v : e.variance) sum += v;
  return sum / static_cast<double>(e.variance.size());
}

// A small flame that few paths meet by chance.
TEST(MediumLight, SamplesReduceTheVariance) {
  MediumDescription flame = emitting_medium(Rgb(0.2f), Rgb(3), Rgb(2000), "flame");
  flame.temperature = 2200;
  scene::Scene scene;
  add(scene, test::quad(8), test::diffuse(Rgb(0.5f)));
  add(scene, scene::box({0.08f, 0.2f, 0.08f}), medium_boundary(flame), at({0, 1, 0}));
  const Document d =
      test::document(std::move(scene), look_at({0, 4, 0.1f}, {2, 0, 0}, {0, 0, 1}, 0.4f), test::kSize, test::kSize);
  const double samples = mean_variance(test::replicated(with_integrator(d, "path"), 16)),
               chance = mean_variance(test::replicated(with_integrator(d, "path-pure"), 16));
  EXPECT_LT(samples * 20, chance);
}

TEST(MediumLight, PathClassesSumToTheImage) {
  for (const auto& [name, d] : fires()) {
    test::expect_sum_of_classes(d, {"EL", "E(D|G|S)+L", "E(D|G|S)*V.*L"}, 4, name);
  }
}

TEST(MediumLight, ThreadsDoNotChangeImages) {
  for (const auto& [name, d] : fires())
    for (const char* integrator : {"path", "distribution"}) {
      const Document chosen = with_integrator(d, integrator);
      const film::Film one = test::rendered(chosen, 4, 1);
      EXPECT_TRUE(test::same_bits(one, test::rendered(chosen, 4, 2))) << name;
      EXPECT_TRUE(test::same_bits(one, test::rendered(chosen, 4, 7))) << name;
    }
}

// ---- Terms of the equation of transfer.

std::vector<image::Layer> terms_of(const Document& d, uint32_t samples, int threads = 0) {
  return render::render_medium_aovs(scene::compile(d.scene, d.camera, nullptr), d, render::medium_aov_names(), samples,
                                    threads);
}

Rgb mean_of_layer(const image::Layer& layer) {
  Rgb sum(0);
  for (size_t i = 0; i < layer.pixels.size(); ++i) sum[static_cast<int>(i % 3)] += layer.pixels[i];
  return sum / static_cast<float>(layer.pixels.size() / 3);
}

void expect_color(const Rgb& value, const Rgb& expected, float tolerance, const std::string& what) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(value[c], expected[c], tolerance) << what << ", channel " << c;
}

// A slab of 2 m that emits, absorbs and scatters, in front of a plate that emits radiance 10. Without in-scattering,
// all terms are known without variance.
TEST(TransportTerms, OfASlab) {
  const Rgb scattering(0.3f, 0.1f, 0), absorption(0.2f, 0.4f, 0.5f), emission(3, 2, 1);
  scene::Scene scene;
  add(scene, scene::box({2, 1, 2}), medium_boundary(emitting_medium(scattering, absorption, emission)));
  add(scene, test::quad(1.5f), test::diffuse(Rgb(0), Rgb(10)), at({0, -1.5f, 0}));
  const Document d =
      test::document(std::move(scene), look_at({0.01f, 3, 0.02f}, {0.01f, 0, 0.02f}, {0, 0, 1}, 1e-4f), 8, 8);
  const auto layers = terms_of(d, 2);
  ASSERT_EQ(layers.size(), 5U);
  Rgb absorbed, scattered, emitted;
  for (int c = 0; c < 3; ++c) {
    const float extinction = scattering[c] + absorption[c], lost = 1 - std::exp(-2 * extinction);
    absorbed[c] = 10 * lost * absorption[c] / extinction;
    scattered[c] = 10 * lost * scattering[c] / extinction;
    emitted[c] = emission[c] * absorption[c] / extinction * lost;
  }
  expect_color(mean_of_layer(layers[0]), Rgb(10), 1e-3f, layers[0].name);
  expect_color(mean_of_layer(layers[1]), absorbed, 1e-3f, layers[1].name);
  expect_color(mean_of_layer(layers[2]), scattered, 1e-3f, layers[2].name);
  expect_color(mean_of_layer(layers[3]), emitted, 1e-3f, layers[3].name);
  for (const image::Layer& layer : layers)
    for (const float v : layer.pixels) EXPECT_TRUE(std::isfinite(v) && v >= 0) << layer.name;
}

// surface - absorption - out-scattering + emission + in-scattering is the image.
TEST(TransportTerms, SumToTheImage) {
  const std::pair<const char*, Document> places[] = {fires()[3], {"fog", test::foggy_cornell_box()}};
  for (const auto& [name, place] : places) {
    const Document d = with_integrator(place, "path");
    double sums[2] = {}, squares[2] = {};
    constexpr int kRepeats = 12;
    for (int repeat = 0; repeat < kRepeats; ++repeat) {
      Document seeded = d;
      seeded.seed = static_cast<uint64_t>(repeat) + 1;
      const auto layers = terms_of(seeded, 24);
      const Rgb terms = mean_of_layer(layers[0]) - mean_of_layer(layers[1]) - mean_of_layer(layers[2]) +
                        mean_of_layer(layers[3]) + mean_of_layer(layers[4]);
      const auto image = static_cast<double>(average(test::mean_color(test::rendered(seeded, 24)))),
                 sum = static_cast<double>(average(terms));
      sums[0] += image, squares[0] += image * image;
      sums[1] += sum, squares[1] += sum * sum;
    }
    double mean[2], variance[2];
    for (int i = 0; i < 2; ++i) {
      mean[i] = sums[i] / kRepeats;
      variance[i] = std::max(squares[i] / kRepeats - mean[i] * mean[i], 0.0) / (kRepeats - 1);
    }
    const double error = std::sqrt(variance[0] + variance[1]);
    // Student's t with about 22 degrees of freedom: one false alarm in 10,000.
    EXPECT_NEAR(mean[0], mean[1], 4.7 * error) << name;
    EXPECT_LT(error, 0.03 * mean[0]) << name;
  }
}

TEST(TransportTerms, DoNotDependOnThreads) {
  const Document d = fires().back().second;
  const auto one = terms_of(d, 3, 1);
  for (const int threads : {2, 7}) {
    const auto other = terms_of(d, 3, threads);
    for (size_t i = 0; i < one.size(); ++i) EXPECT_EQ(one[i].pixels, other[i].pixels) << one[i].name;
  }
}

}  // namespace
}  // namespace etendue::media_emission
