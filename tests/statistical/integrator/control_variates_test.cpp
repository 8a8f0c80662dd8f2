// Path tracing with a control variate for direct light: it has at most the variance of the balance heuristic, a resumed
// rendering continues to the same bits, and images do not depend on threads or parts. That it is unbiased follows from
// the tests over all integrators (Pairwise, Furnace) and from the comparison below; the best coefficient has closed-form
// tests (DirectLightControl).
#include <gtest/gtest.h>

#include "support/independent_estimates.h"
#include "support/integrator_scenes.h"
#include "support/resume.h"

namespace etendue {
namespace {

using render::Document;
using test::with;
using test::with_integrator;

Document with_control(const Document& document, const char* control, int size) {
  Document d = with(with_integrator(document, "path-control"), "control", control);
  d.width = d.height = size;
  return d;
}

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

// t-tests with a false-alarm rate of 1 %, where a fifth of the samples are negative.
TEST(ControlVariates, AgreeWithPathTracing) {
  const Document d = with(test::balls_under_sun(), "max-depth", "2");
  for (const char* control : {"optimal", "ambient"}) {
    const Document controlled = with_control(d, control, 24);
    Document reference = with_integrator(d, "path");
    reference.width = reference.height = 24;
    test::expect_same_mean(reference, 128, controlled, 128, control, 2);
  }
}

// The variances of 1728 values have relative standard errors of about 4 %.
TEST(ControlVariates, ReduceTheVarianceOfDirections) {
  const Document d = with(test::balls_under_sky(), "max-depth", "2");
  Document balance = with(with_integrator(d, "path"), "heuristic", "balance");
  balance.width = balance.height = 24;
  const double without = variance_of_samples(balance);
  for (const char* control : {"optimal", "ambient"}) {
    const double with_it = variance_of_samples(with_control(d, control, 24));
    EXPECT_LT(with_it, 1.1 * without) << control;
    std::printf("%s %g\n", control, with_it / without);
  }
}

TEST(ControlVariates, ResumeToTheSameBits) {
  test::expect_same_bits_after_resume(with_control(test::balls_under_sky(), "optimal", 40), "path-control");
}

TEST(ControlVariates, ThreadsDoNotMatter) {
  const Document d = with_control(test::balls_under_sky(), "optimal", 70);
  const auto one = test::rendered(d, 15, 1);
  for (const int threads : {2, 7}) test::expect_same_bits(one, test::rendered(d, 15, threads), "path-control");
}

}  // namespace
}  // namespace etendue
