// A glass ball on a diffuse floor, under a small lamp.                                                  digest 8-10: F4
#pragma once
#include "scene/builtin/builtin.h"
#include "stress/case.h"

namespace etendue::stress {

inline void caustic_of_a_small_lamp(Lab& lab) {
  scene::Scene scene = scene::find_builtin("glass-caustic")->make();
  const Camera camera = *scene::choose_camera(scene, "");
  auto with_glass = lab.document(scene, camera);
  std::erase_if(scene.roots, [&](int root) { return scene.nodes[static_cast<size_t>(root)].name == "glass ball"; });
  auto without = lab.document(std::move(scene), camera);
  for (auto* d : {&with_glass, &without}) d->width = d->height = 64;
  constexpr uint32_t kSamples = 256;
  const auto khat = [&](const render::Document& d) { return lab.tail(d, kSamples).khat.value_or(-1); };
  // From 0.7 on, the error that a picture states means nothing.
  lab.expect_between("path", "khat with the ball", khat(with_glass), 0.7, kInfinity);
  lab.expect_between("path", "khat without it", khat(without), -kInfinity, 0.5);
  with_glass.method.paths = "EDS+L", with_glass.width = with_glass.height = 16;
  const auto caustic = [&](const char* method) { return lab.mean(Lab::with_method(with_glass, method), 128).value; };
  const double expected = caustic("light");
  lab.expect_near("bdpt", "the caustic by light tracing", caustic("bdpt"), expected, 0.02);
  lab.expect_near("sppm", "the caustic by light tracing", caustic("sppm"), expected, 0.2);
}

inline constexpr Case kCausticOfASmallLamp{
    "caustic-of-a-small-lamp", Kind::heavy_tails,
    "A connection through glass is blocked, so that only chance finds the lamp: a few samples carry the caustic, and "
    "the rendering must say that its error is not to be trusted; walks from the lamp and photons find it with ease",
    caustic_of_a_small_lamp};

}  // namespace etendue::stress
