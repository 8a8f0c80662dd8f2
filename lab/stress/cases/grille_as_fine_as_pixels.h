// Bright bars and gaps of the same width, about one pair for each column of pixels.                    digest 8-10: F28
#pragma once
#include "stress/case.h"

namespace etendue::stress {

// So many bars across the picture, the first of them in the middle of its pair.
inline render::Document grille(const Lab& lab, int bars) {
  constexpr float kFov = 1;
  const float width = 2 * std::tan(0.5f * kFov), pair = width / static_cast<float>(bars);
  scene::Scene scene;
  for (int i = 0; i < bars; ++i) {
    Mat4 place(1);
    place[0][0] = 0.25f * pair, place[3].x = (static_cast<float>(i) + 0.5f) * pair - 0.5f * width;
    scene::add(scene, scene::quad(1), scene::diffuse(Rgb(0), Rgb(1)), place);
  }
  return lab.document(std::move(scene), look_at({0, 1, 0}, {0, 0, 0}, {0, 0, -1}, kFov));
}

inline void grille_as_fine_as_pixels(Lab& lab) {
  const auto seen = [&](const render::Document& d, film::FilterKind filter, const char* sampler, uint32_t samples) {
    auto sampled = Lab::with_method(d, std::string("raycast:sampler=") + sampler);
    sampled.filter = filter;
    return lab.mean(sampled, samples);
  };
  using enum film::FilterKind;
  const auto even = grille(lab, lab.options().size), beating = grille(lab, lab.options().size + 1);
  for (const uint32_t samples : {1U, 64U}) {
    const std::string point = std::to_string(samples) + " samples: ";
    lab.expect_near("raycast", point + "centres see nothing but bars", seen(even, centre, "sobol", samples).value, 1,
                    1e-6);
    lab.expect_between("raycast", point + "a bar as broad as the picture, by variance",
                       seen(beating, centre, "sobol", samples).variance, 0.24, 0.26);
  }
  for (const char* sampler : {"random", "stratified", "halton", "sobol"}) {
    const std::string method = std::string("raycast:sampler=") + sampler;
    lab.expect_mean(method, "half of it is bars", seen(even, box, sampler, 64), 0.5);
    lab.expect_between(method, "variance of a pixel after 64 samples", seen(beating, box, sampler, 64).variance, 0,
                       0.3 / 64);
  }
}

inline constexpr Case kGrilleAsFineAsPixels{
    "grille-as-fine-as-pixels", Kind::bias,
    "What the centres of pixels miss no number of samples brings back; chance makes noise of it, which falls",
    grille_as_fine_as_pixels};

}  // namespace etendue::stress
