// Path tracing with a control variate for direct light: it has at most the variance of the balance heuristic, a resumed
// rendering continues to the same bits, and images do not depend on threads or parts. That it is unbiased follows from
// the tests over all integrators (Pairwise, Furnace) and from the comparison below; the best coefficient has closed-form
// tests (DirectLightControl).
#include <gtest/gtest.h>

#include "image/image.h"
#include "support/independent_estimates.h"
#include "support/integrator_scenes.h"
#include "support/resume.h"

namespace etendue::control_variates_test {
namespace {

using render::Document;
using test::with;
using test::with_integrator;

// Without the media of glass, for which there is no control.
Document without_glass(Document d) {
  auto scene = std::make_shared<scene::Scene>(*d.scene);
  for (auto& material : scene->materials) material.transmission = 0;
  d.scene = std::move(scene);
  return d;
}

Document with_control(const Document& document, const char* control) {
  return with(with_integrator(document, "path-control"), "control", control);
}

// Direct illumination only.
Document direct(const Document& d) { return with(d, "max-depth", "2"); }

// The variance of one sample, summed over the pixels, for independent random numbers.
double variance_of_samples(Document d) {
  d.method.sampler = "random";
  constexpr uint32_t kSamples = 512;
  const auto film = test::rendered(d, kSamples);
  const auto other = [&] {
    Document again = d;
    again.seed = d.seed + 1;
    return test::rendered(again, kSamples);
  }();
  double sum = 0;
  for (int y = 0; y < d.height; ++y)
    for (int x = 0; x < d.width; ++x)
      for (int c = 0; c < 3; ++c) sum += sqr(double{film.mean(x, y)[c]} - double{other.mean(x, y)[c]});
  return sum * kSamples / 2;
}

// t-tests with a false-alarm rate of 1 %.
TEST(ControlVariates, AgreeWithPathTracing) {
  const Document d = without_glass(test::balls_under_sun());
  for (const char* control : {"optimal", "ambient"})
    test::expect_same_mean(direct(with_integrator(d, "path")), 256, direct(with_control(d, control)), 256, control, 2);
}

// The luminance of a map decides what is sampled, but a tint can make a sampled part of it black.
TEST(ControlVariates, BlackPartsOfTheEnvironmentAreControlled) {
  Document d = without_glass(test::balls_under_sun());
  auto scene = std::make_shared<scene::Scene>(*d.scene);
  auto map = std::make_shared<image::Image>();
  map->width = 8;
  map->height = 4;
  map->channels = 3;
  map->type = image::PixelType::float32;
  for (int i = 0; i < map->width * map->height; ++i) {
    const bool is_red = i % map->width < 4;
    for (const float c : {is_red ? 1.0f : 0.0f, 0.0f, is_red ? 0.0f : 30.0f}) map->floats.push_back(c);
  }
  scene->environment = {};
  scene->environment.map = map;
  scene->environment.tint = {1, 0, 0};
  d.scene = std::move(scene);
  for (const char* control : {"optimal", "ambient"})
    test::expect_same_mean(direct(with_integrator(d, "path")), 256, direct(with_control(d, control)), 256, control, 2);
}

// The variances are sums over 6912 values, with relative standard errors of about 2 %.
TEST(ControlVariates, ReduceTheVarianceOfDirections) {
  Document d = without_glass(test::balls_under_sun());
  d.width = d.height = 48;
  const double balance = variance_of_samples(with(direct(with_integrator(d, "path")), "heuristic", "balance"));
  const double optimal = variance_of_samples(direct(with_control(d, "optimal")));
  const double ambient = variance_of_samples(direct(with_control(d, "ambient")));
  EXPECT_LT(optimal, 0.94 * balance);
  EXPECT_LT(ambient, 0.94 * balance);
}

TEST(ControlVariates, ResumeToTheSameBits) {
  test::expect_same_bits_after_resume(with_control(without_glass(test::balls_under_sun()), "optimal"), "path-control",
                                      false);
}

TEST(ControlVariates, ThreadsDoNotMatter) {
  Document d = with_control(without_glass(test::balls_under_sun()), "optimal");
  d.width = d.height = 70;
  const auto one = test::rendered(d, 15, 1);
  for (const int threads : {2, 7}) test::expect_same_bits(one, test::rendered(d, 15, threads), "path-control");
}

}  // namespace
}  // namespace etendue::control_variates_test
