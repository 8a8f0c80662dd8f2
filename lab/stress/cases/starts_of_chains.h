// A small lamp in the dark: nearly all candidates for the starts of Markov chains are worth nothing.   digest 8-10: F24
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void starts_of_chains(Lab& lab) {
  constexpr float kShare = 0.01f, kDistance = 4, kField = 0.8f;
  scene::Scene scene;
  const float size = kDistance * std::tan(0.5f * kField) * std::sqrt(kShare);
  Mat4 place(1);
  place[0][0] = place[2][2] = size;
  scene::add(scene, scene::quad(1), scene::diffuse(Rgb(0), Rgb(1)), place);
  const auto d = lab.document(std::move(scene), look_at({0, kDistance, 0}, {0, 0, 0}, {0, 0, 1}, kField));
  constexpr uint32_t kSamples = 512;
  // What is known of the brightness comes from the candidates and the large steps.
  const double large = 0.3 * kSamples * d.width * d.height;
  const double within = 4.5 / std::sqrt(large * double{kShare});
  for (const char* form : {"path", "bidirectional"})
    for (const char* candidates : {"10000", "16"})
      lab.expect_near(
          std::string("pssmlt:form=") + form, std::string("candidates ") + candidates,
          lab.mean(Lab::with_method(d, std::string("pssmlt:form=") + form + ":candidates=" + candidates), kSamples)
              .value,
          double{kShare}, within);
  // The same from bidirectional mutations: 1.5 % noise by eight seeds.
  for (const char* candidates : {"16384", "16"})
    lab.expect_near("mlt", std::string("candidates ") + candidates,
                    lab.mean(Lab::with_method(d, std::string("mlt:candidates=") + candidates), kSamples).value,
                    double{kShare}, 0.07);
}

inline constexpr Case kStartsOfChains{
    "starts-of-chains", Kind::bias,
    "Most candidates for the starts of Markov chains are black: they must be passed over without making the picture "
    "brighter, and drawn again where all of them are",
    starts_of_chains};

}  // namespace etendue::stress
