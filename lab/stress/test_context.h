// The environment of a stability case: renders small images and records expected and measured values.
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "film/film_mean.h"
#include "film/tail.h"
#include "render/document.h"
#include "scene/builtin/shapes.h"

namespace etendue::stress {

// An image after the display transform, 8-bit RGB.
struct Thumbnail {
  int width = 0, height = 0;
  std::vector<uint8_t> rgb;
};

// One expectation of a case and the value measured for it.
struct TestResult {
  std::string method;       // an integrator with settings ("path:max-depth=2"), a sampler, or another component
  std::string expectation;  // with the parameter value of a sweep: "albedo 0.9: 10 within 0.1 %"
  double measured = 0;
  bool ok = false;
  Thumbnail image;  // of the most recent rendering; empty if there was none
};

struct TestOptions {
  uint64_t seed = 0;
  int threads = 0;  // 0: one per hardware thread
  int size = 32;    // width and height of the images, pixels
};

class TestContext {
 public:
  explicit TestContext(const TestOptions& options) : options_(options) {}

  const TestOptions& options() const { return options_; }

  // A document with a square image of the scene.
  render::Document document(scene::Scene scene, const Camera& camera) const;
  // The document with another method, written as for `etendue bench`: "path", "path-pure:max-depth=3:sampler=random".
  static render::Document with_method(const render::Document& document, const std::string& method);

  film::Film render(const render::Document& document, uint32_t samples);
  // Statistics of the largest samples of a rendering.
  film::Tail tail(const render::Document& document, uint32_t samples);
  film::Mean mean(const render::Document& document, uint32_t samples) {
    return film::mean_of(render(document, samples));
  }
  // The variance of a pixel, averaged over the image: half of the mean squared difference of two seeds.
  double squared_error(const render::Document& document, uint32_t samples);

  // Each of these records a result. `point` names the parameter value of a sweep ("albedo 0.9"); it may be empty.
  void expect_near(const std::string& method, const std::string& point, double measured, double expected,
                   double relative_tolerance);
  // Expects the mean within kSigmas standard errors: one false alarm in 150,000 results.
  static constexpr double kSigmas = 4.5;
  void expect_mean(const std::string& method, const std::string& point, const film::Mean& measured, double expected);
  void expect_between(const std::string& method, const std::string& point, double measured, double minimum,
                      double maximum);
  void expect_zero(const std::string& method, const std::string& point, double measured);

  std::vector<TestResult> take_results();

 private:
  void add(const std::string& method, const std::string& point, std::string expectation, double measured, bool ok);

  TestOptions options_;
  Thumbnail image_;
  std::vector<TestResult> results_;
};

// The integrators that declare to be unbiased and to find every path from lights with an extent through a pinhole.
std::vector<std::string> unbiased_integrators();

// A camera at `eye` with such a small field of view that all pixels see the point `target`.
Camera narrow_camera(const Vec3& eye, const Vec3& target);

// An empty scene with an environment of radiance one.
scene::Scene uniform_sky();
using scene::add_point_light;

std::string number(double value);  // four significant digits

}  // namespace etendue::stress
