// One measurement, the mean radiance of an image, by its four formulations [Lang, eq. 5.122-5.135], each with the integrator that
// evaluates it:
//
//   path       <W_ei, L_o>   importance of the camera times exitant radiance, found by paths from the camera
//   light      <W_i, L_eo>   emitted radiance times incident importance, found by paths from the light
//   bdpt       both, connected in the middle
//   radiosity  exitant radiance of patches, solved as a linear system
//
// The matrices of a small scene are compared in lab/experiments/transport_operators.cpp.
#include <gtest/gtest.h>

#include <cmath>

#include "support/integrator_scenes.h"

namespace etendue::measurements {
namespace {

using render::Document;

constexpr double kStandardErrors = 4.5;
constexpr int kRepeats = 12;

struct Measurement {
  double mean = 0, standard_error = 0;
};

// The luminance of the mean of the image, over independent renderings.
Measurement measured(const Document& place, const std::string& integrator, uint32_t samples) {
  Document d = test::with_integrator(place, integrator);
  d.method.sampler = "random";
  double sum = 0, squares = 0;
  for (int repeat = 0; repeat < kRepeats; ++repeat) {
    d.seed = 500 + static_cast<uint64_t>(repeat);
    const double value = double{luminance(test::mean_color(test::rendered(d, samples)))};
    sum += value;
    squares += value * value;
  }
  const double mean = sum / kRepeats;
  return {mean, std::sqrt(std::max(0.0, squares / kRepeats - mean * mean) / (kRepeats - 1))};
}

// Closed, Lambertian, emission one: all formulations measure 1 / (1 - albedo). Patches hold the solution exactly.
TEST(Measurements, FourFormulationsInAFurnace) {
  Document d = test::document(test::furnace(0.75f), look_at({0.3f, 0.1f, -0.2f}, {0, 0, 1}, {0, 1, 0}, 1), 16, 16);
  d = test::with(d, "radiosity.patches", "300");
  for (const char* integrator : {"path", "light", "bdpt", "radiosity"}) {
    const Measurement m = measured(d, integrator, 32);
    EXPECT_NEAR(m.mean, 4, kStandardErrors * m.standard_error + 0.004) << integrator;
    EXPECT_LT(m.standard_error, 0.04) << integrator;
  }
}

// The Cornell box: paths agree within their standard errors, radiosity within the error of its mesh, 1 %.
TEST(Measurements, FourFormulationsInTheCornellBox) {
  const Document d = test::cornell(32);
  const Measurement path = measured(d, "path", 64), light = measured(d, "light", 64), bdpt = measured(d, "bdpt", 64),
                    radiosity = measured(d, "radiosity", 16);
  for (const auto& [name, other] : {std::pair("light", light), std::pair("bdpt", bdpt)})
    EXPECT_NEAR(other.mean, path.mean, kStandardErrors * std::hypot(other.standard_error, path.standard_error)) << name;
  EXPECT_NEAR(radiosity.mean, path.mean,
              kStandardErrors * std::hypot(radiosity.standard_error, path.standard_error) + 0.01 * path.mean);
  for (const Measurement& m : {path, light, bdpt, radiosity}) EXPECT_LT(m.standard_error, 0.01 * path.mean);
}

}  // namespace
}  // namespace etendue::measurements
