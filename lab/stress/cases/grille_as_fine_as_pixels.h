// Bright bars and gaps of equal width, about one pair per column of pixels.   [Lang, sec. 8.4.3.1; Cook 1986]
#pragma once
#include "stress/case.h"

namespace etendue::stress {

// This many pairs of a bar and a gap across the image, with each bar in the middle of its pair.
inline render::Document grille(const TestContext& test, int bars) {
  constexpr float kFov = 1;
  const float width = 2 * std::tan(0.5f * kFov), pair = width / static_cast<float>(bars);
  scene::Scene scene;
  for (int i = 0; i < bars; ++i) {
    Mat4 transform(1);
    transform[0][0] = 0.25f * pair;
    transform[3].x = (static_cast<float>(i) + 0.5f) * pair - 0.5f * width;
    scene::add(scene, scene::quad(1), scene::diffuse(Rgb(0), Rgb(1)), transform);
  }
  return test.document(std::move(scene), look_at({0, 1, 0}, {0, 0, 0}, {0, 0, -1}, kFov));
}

inline void grille_as_fine_as_pixels(TestContext& test) {
  const auto mean = [&](const render::Document& d, film::FilterKind filter, const char* sampler, uint32_t samples) {
    auto sampled = TestContext::with_method(d, std::string("raycast:sampler=") + sampler);
    sampled.filter = filter;
    return test.mean(sampled, samples);
  };
  using enum film::FilterKind;
  const auto aligned = grille(test, test.options().size), beating = grille(test, test.options().size + 1);
  for (const uint32_t samples : {1U, 64U}) {
    const std::string point = std::to_string(samples) + " samples: ";
    test.expect_near("raycast", point + "pixel centres sample bars only", mean(aligned, centre, "sobol", samples).value,
                     1, 1e-6);
    test.expect_between("raycast", point + "variance of the Moire pattern",
                        mean(beating, centre, "sobol", samples).variance, 0.24, 0.26);
  }
  for (const char* sampler : {"random", "stratified", "halton", "sobol"}) {
    const std::string method = std::string("raycast:sampler=") + sampler;
    test.expect_mean(method, "mean", mean(aligned, box, sampler, 64), 0.5);
    test.expect_between(method, "variance of a pixel with 64 samples", mean(beating, box, sampler, 64).variance, 0,
                        0.3 / 64);
  }
}

inline constexpr Case kGrilleAsFineAsPixels{
    .name = "grille-as-fine-as-pixels",
    .kind = Kind::bias,
    .theory =
        "Samples at pixel centres alias at any sample count; random samples replace the aliasing by "
        "noise, which decreases",
    .run = grille_as_fine_as_pixels};

}  // namespace etendue::stress
