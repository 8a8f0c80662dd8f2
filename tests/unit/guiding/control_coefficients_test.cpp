// The control variate of direct light, in a domain of two directions, where all moments are sums.
#include <gtest/gtest.h>

#include <array>

#include "integrator/control/control_coefficients.h"
#include "integrator/control/direct_light_control.h"

namespace etendue {
namespace {

using integrator::control_coefficient;
using integrator::control_factor;
using integrator::ControlTerm;
using integrator::light_factor;

struct TwoDirections {
  std::array<float, 2> f, light_pdf, bsdf_pdf;

  struct Moments {
    double mean = 0, variance = 0;
  };
  // Of an estimate that adds a term at one light sample and one at one BSDF sample, with control coefficient c.
  Moments moments(ControlTerm term, double c) const {
    Moments total;
    for (const bool at_light : {true, false}) {
      double mean = 0, square = 0;
      for (size_t i = 0; i < 2; ++i) {
        const double probability = double{at_light ? light_pdf[i] : bsdf_pdf[i]};
        const double value = double{f[i] * light_factor(term, light_pdf[i], bsdf_pdf[i])} +
                             c * double{control_factor(term, light_pdf[i], bsdf_pdf[i], at_light)};
        mean += probability * value;
        square += probability * value * value;
      }
      total.mean += mean;
      total.variance += square - mean * mean;
    }
    return total;
  }

  double best_coefficient() const {
    return double{control_coefficient({.difference = Rgb(static_cast<float>(moments(ControlTerm::difference, 0).mean)),
                                       .albedo = Rgb(1),
                                       .overlap = Rgb(static_cast<float>(moments(ControlTerm::overlap, 1).mean))})
                      .r};
  }
};

constexpr std::array kCases{TwoDirections{{1, 5}, {0.3f, 0.7f}, {0.6f, 0.4f}},
                            TwoDirections{{4, 0.5f}, {0.05f, 0.95f}, {0.9f, 0.1f}},
                            TwoDirections{{2, 2}, {0.2f, 0.8f}, {0.5f, 0.5f}}};

TEST(DirectLightControl, KeepsTheMean) {
  for (const TwoDirections& two : kCases)
    for (const double c : {-3.0, 0.0, 1.0, 7.0})
      EXPECT_NEAR(two.moments(ControlTerm::radiance, c).mean, double{two.f[0] + two.f[1]}, 1e-5);
}

TEST(DirectLightControl, HasTheLeastVarianceWithItsCoefficient) {
  for (const TwoDirections& two : kCases) {
    const double best = two.best_coefficient();
    const double least = two.moments(ControlTerm::radiance, best).variance;
    EXPECT_LT(least, 0.99 * two.moments(ControlTerm::radiance, 0).variance) << "the case tests nothing";
    for (const double step : {-1e-2, 1e-2}) EXPECT_GT(two.moments(ControlTerm::radiance, best + step).variance, least);
  }
}

// The optimal estimator has no variance if f is a combination of the densities [Kondapaneni et al. 2019, sec. 4].
TEST(DirectLightControl, IsExactForCombinationsOfTheDensities) {
  for (TwoDirections two : kCases) {
    for (size_t i = 0; i < 2; ++i) two.f[i] = 3 * two.light_pdf[i] - 0.25f * two.bsdf_pdf[i];
    EXPECT_NEAR(two.best_coefficient(), 3.25, 1e-4);
    EXPECT_NEAR(two.moments(ControlTerm::radiance, two.best_coefficient()).variance, 0, 1e-6);
  }
}

TEST(DirectLightControl, EqualDensitiesHaveAFiniteCoefficient) {
  const TwoDirections two{{1, 5}, {0.5f, 0.5f}, {0.5f, 0.5f}};
  EXPECT_NEAR(two.best_coefficient(), 0, 1e-6);
  EXPECT_EQ(control_coefficient({}), Rgb(0));
}

}  // namespace
}  // namespace etendue
