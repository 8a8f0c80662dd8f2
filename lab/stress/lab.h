// What the cases work with: small renderings, and a book of what was expected and what was found.
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

// A picture as displayed, small enough for a table.
struct Thumbnail {
  int width = 0, height = 0;
  std::vector<uint8_t> rgb;
};

// What one method did at one point of a case.
struct Finding {
  std::string method;       // an integrator with what was set ("path:max-depth=2"), a sampler, or a part of the program
  std::string expectation;  // in numbers, with the point of the sweep: "albedo 0.9: 10 within 0.1 %"
  double measured = 0;
  bool ok = false;
  Thumbnail picture;  // of the last rendering before; empty if there was none
};

struct LabOptions {
  uint64_t seed = 0;
  int threads = 0;
  int size = 32;  // width and height of the pictures, pixels
};

class Lab {
 public:
  explicit Lab(const LabOptions& options) : options_(options) {}

  const LabOptions& options() const { return options_; }

  // A document of a square picture.
  render::Document document(scene::Scene scene, const Camera& camera) const;
  // The same with a method as `bench` takes it: "path", "path-pure:max-depth=3:sampler=random".
  static render::Document with_method(const render::Document& document, const std::string& method);

  film::Film render(const render::Document& document, uint32_t samples);
  // The tail of all samples of a rendering.
  film::Tail tail(const render::Document& document, uint32_t samples);
  film::Mean mean(const render::Document& document, uint32_t samples) {
    return film::mean_of(render(document, samples));
  }
  // Of a pixel, by how much two pictures with other seeds differ: the mean over all pixels.
  double squared_error(const render::Document& document, uint32_t samples);

  // Each writes a finding; `point` says where in a sweep ("albedo 0.9"), and may be empty.
  void expect_near(const std::string& method, const std::string& point, double measured, double expected,
                   double relative);
  // Within kSigmas standard errors: one false alarm in 150,000 findings.
  static constexpr double kSigmas = 4.5;
  void expect_mean(const std::string& method, const std::string& point, const film::Mean& measured, double expected);
  void expect_between(const std::string& method, const std::string& point, double measured, double least, double most);
  void expect_zero(const std::string& method, const std::string& point, double measured);

  std::vector<Finding> take_findings();

 private:
  void add(const std::string& method, const std::string& point, std::string expectation, double measured, bool ok);

  LabOptions options_;
  Thumbnail picture_;
  std::vector<Finding> findings_;
};

// The integrators that claim to be unbiased and to find every path of lights with an extent, also through a pinhole.
std::vector<std::string> unbiased_methods();

// A camera so far off that all of its pixels see one point of a surface: a telescope at `target`.
Camera telescope(const Vec3& eye, const Vec3& target);

// An empty scene under a sky of radiance one.
scene::Scene sky();
using scene::add_point_light;

// Correlation of what two pictures deviate from their means, the second shifted to the left by so many pixels.
double noise_correlation(const film::Film& a, const film::Film& b, int shift);
// Of the mean of both pictures, over its pixels.
double variance_of_mean(const film::Film& a, const film::Film& b);
// The share of pixels whose first 64 samples leave half or more of 8 x 8 cells empty, in this dimension and the next.
double clumped_pixels(const std::string& sampler, uint32_t dimension);

std::string number(double value);

}  // namespace etendue::stress
