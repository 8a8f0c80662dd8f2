// Two emitters in the dark, one three times as bright as the other, and Markov chains that rarely move from one to the
// other.   [Lang, sec. 9.4.1, Remark 9.18]
#pragma once
#include "bench/method_spec.h"
#include "stress/case.h"

namespace etendue::stress {

inline void chains_in_two_places(TestContext& test) {
  scene::Scene scene;
  for (const float x : {-1.0f, 1.0f}) {
    Mat4 transform(1);
    transform[0][0] = transform[2][2] = 0.2f;
    transform[3].x = x;
    scene::add(scene, scene::quad(1), scene::diffuse(Rgb(0), Rgb(x < 0 ? 1.0f : 3.0f)), transform);
  }
  const auto d = test.document(std::move(scene), look_at({0, 4, 0}, {0, 0, 0}, {0, 0, -1}, 0.8f));
  const auto brightness = [&](const film::Film& film, int side) {
    double sum = 0;
    for (int y = 0; y < d.height; ++y)
      for (int x = 0; x < d.width / 2; ++x) sum += average(film.mean(x + side * d.width / 2, y));
    return sum / (d.width * d.height);
  };
  const auto truth = test.render(TestContext::with_method(d, "raycast"), 256);
  // Some hundred bootstrap samples hit an emitter, which leaves 4 % noise.
  for (const char* method : {"mlt:bidirectional=0.01:chains=256", "pssmlt:large-steps=0.01:chains=256"}) {
    const auto film = test.render(TestContext::with_method(d, method), 64);
    for (const int side : {0, 1})
      test.expect_near(method, side == 0 ? "darker emitter" : "brighter emitter",
                       brightness(film, side) / brightness(truth, side), 1, 0.2);
  }
  test.expect_near("mlt:bidirectional=0", "accepted", bench::parse_method("mlt:bidirectional=0", d) ? 1 : 0, 0, 0);
}

inline constexpr Case kChainsInTwoPlaces{
    .name = "chains-in-two-places",
    .kind = Kind::bias,
    .theory =
        "Chains that stay near their start show each emitter as brightly as starts were chosen there; "
        "starts chosen in proportion to their contribution leave noise but no bias",
    .run = chains_in_two_places};

}  // namespace etendue::stress
