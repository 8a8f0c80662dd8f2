// Every unbiased method gives the same image: z-tests over independent renderings, 1 % false alarms for the family.
#include <gtest/gtest.h>

#include "integrator/integrator.h"
#include "support/motion.h"
#include "support/replicates.h"

namespace etendue {
namespace {

using test::kSize;

void expect_agreement(const render::Document& d, uint32_t samples_of_first, const std::string& first,
                      uint32_t samples_of_second, const std::string& second) {
  auto a = d, b = d;
  a.method.integrator = first, b.method.integrator = second;
  test::expect_agreement(test::replicated(a, samples_of_first), test::replicated(b, samples_of_second),
                         first + ' ' + second);
}

TEST(Agreement, CornellBox) {
  auto d = *render::new_document("cornell");
  d.width = d.height = kSize;
  expect_agreement(d, 256, "path", 2048, "path-pure");
}

// Every lobe and every weight takes part.
TEST(Agreement, GlossyThings) { expect_agreement(test::glossy_things(), 512, "path", 1024, "path-pure"); }

// Everything moves, the camera and the light too, and most of it is out of focus.
TEST(Agreement, LensAndShutter) { expect_agreement(test::lens_and_shutter(), 512, "path", 2048, "path-pure"); }

TEST(Agreement, LensAndShutterFromTheLight) { expect_agreement(test::lens_and_shutter(), 512, "path", 1024, "light"); }
TEST(Agreement, LensAndShutterFromBothEnds) { expect_agreement(test::lens_and_shutter(), 512, "path", 256, "bdpt"); }

// The depth limit cuts both at the same path length.
TEST(Agreement, DirectLightOnly) {
  auto d = *render::new_document("cornell");
  d.width = d.height = kSize;
  d = *render::with_text(d, "path.max-depth", "2");
  d = *render::with_text(d, "path-pure.max-depth", "2");
  expect_agreement(d, 128, "path", 2048, "path-pure");
}

// Scrambled points find the same pixels with less noise.
TEST(Samplers, SobolBeatsRandomOnCornell) {
  auto d = *render::new_document("cornell");
  d.width = d.height = 64;
  d.seed = 99;
  const auto reference = test::rendered(d, 4096);
  d.seed = 1;
  const auto mse = [&](const char* sampler) {
    d.method.sampler = sampler;
    const auto film = test::rendered(d, 64);
    double sum = 0;
    for (int y = 0; y < d.height; ++y)
      for (int x = 0; x < d.width; ++x)
        for (int c = 0; c < 3; ++c) sum += sqr(double{film.mean(x, y)[c]} - reference.mean(x, y)[c]);
    return sum;
  };
  EXPECT_GT(mse("random"), 2 * mse("sobol"));
}

}  // namespace
}  // namespace etendue
