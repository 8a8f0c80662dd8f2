// A small light in the dark, so that almost all bootstrap samples of Markov chains are black.   [Lang, sec. 9.4.1]
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void starts_of_chains(TestContext& test) {
  constexpr float kShare = 0.01f, kDistance = 4, kField = 0.8f;
  scene::Scene scene;
  const float size = kDistance * std::tan(0.5f * kField) * std::sqrt(kShare);
  Mat4 transform(1);
  transform[0][0] = transform[2][2] = size;
  scene::add(scene, scene::quad(1), scene::diffuse(Rgb(0), Rgb(1)), transform);
  const auto d = test.document(std::move(scene), look_at({0, kDistance, 0}, {0, 0, 0}, {0, 0, 1}, kField));
  constexpr uint32_t kSamples = 512;
  // Large steps determine the brightness of the image.
  const double large_steps = 0.3 * kSamples * d.width * d.height;
  const double within = 4.5 / std::sqrt(large_steps * double{kShare});
  for (const char* form : {"path", "bidirectional"})
    for (const char* candidates : {"10000", "16"})
      test.expect_near(
          std::string("pssmlt:form=") + form, std::string("candidates ") + candidates,
          test.mean(TestContext::with_method(d, std::string("pssmlt:form=") + form + ":candidates=" + candidates),
                    kSamples)
              .value,
          double{kShare}, within);
  // For mlt, bidirectional mutations do; the standard deviation over eight seeds is 1.5 %.
  for (const char* candidates : {"16384", "16"})
    test.expect_near(
        "mlt", std::string("candidates ") + candidates,
        test.mean(TestContext::with_method(d, std::string("mlt:candidates=") + candidates), kSamples).value,
        double{kShare}, 0.07);
}

inline constexpr Case kStartsOfChains{
    .name = "starts-of-chains",
    .kind = Kind::bias,
    .theory =
        "Black bootstrap samples must be skipped without changing the brightness of the image, and "
        "drawn again if all of them are black",
    .run = starts_of_chains};

}  // namespace etendue::stress
