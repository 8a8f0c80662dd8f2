// Two lamps in the dark, one three times as bright as the other, and chains that hardly ever go from one to the other.
//                                                                                                 digest 8-10: F24, S24
#pragma once
#include "bench/method_spec.h"
#include "stress/case.h"

namespace etendue::stress {

inline void chains_in_two_places(Lab& lab) {
  scene::Scene scene;
  for (const float x : {-1.0f, 1.0f}) {
    Mat4 place(1);
    place[0][0] = place[2][2] = 0.2f, place[3].x = x;
    scene::add(scene, scene::quad(1), scene::diffuse(Rgb(0), Rgb(x < 0 ? 1.0f : 3.0f)), place);
  }
  const auto d = lab.document(std::move(scene), look_at({0, 4, 0}, {0, 0, 0}, {0, 0, -1}, 0.8f));
  const auto brightness = [&](const film::Film& film, int side) {
    double sum = 0;
    for (int y = 0; y < d.height; ++y)
      for (int x = 0; x < d.width / 2; ++x) sum += average(film.mean(x + side * d.width / 2, y));
    return sum / (d.width * d.height);
  };
  const auto truth = lab.render(Lab::with_method(d, "raycast"), 256);
  // Some hundred of their candidates for starts are lit: 4 % noise.
  for (const char* method : {"mlt:bidirectional=0.01:chains=256", "pssmlt:large-steps=0.01:chains=256"}) {
    const auto film = lab.render(Lab::with_method(d, method), 64);
    for (const int side : {0, 1})
      lab.expect_near(method, side == 0 ? "the darker one" : "the brighter one",
                      brightness(film, side) / brightness(truth, side), 1, 0.2);
  }
  lab.expect_near("mlt:bidirectional=0", "is refused", bench::parse_method("mlt:bidirectional=0", d) ? 1 : 0, 0, 0);
}

inline constexpr Case kChainsInTwoPlaces{
    "chains-in-two-places", Kind::bias,
    "Chains that stay where they began show each place as brightly as their starts were many there: starts that are "
    "chosen by what they are worth leave no bias, only noise",
    chains_in_two_places};

}  // namespace etendue::stress
