// A shutter that opens and closes at one instant.                                                      digest 8-10: F30
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void shutter_of_no_time(Lab& lab) {
  scene::Scene scene = sky();
  const int ball = scene::add(scene, scene::sphere(0.5f, 24, false), scene::diffuse(Rgb(0)));
  scene::AnimationChannel channel;
  channel.node = ball;
  channel.times = {0, 1}, channel.values = {-1, 0, 0, 1, 0, 0};
  auto animation = std::make_shared<scene::Animation>();
  animation->channels.push_back(channel);
  scene.animations.push_back(std::move(animation));
  scene.time = 0.5f;
  const auto d = lab.document(std::move(scene), look_at({0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 1));
  const auto open_for = [&](const std::string& method, float seconds) {
    auto blurred = Lab::with_method(d, method);
    blurred.camera.shutter = seconds;
    return lab.mean(blurred, 64).value;
  };
  for (const auto& method : unbiased_methods()) {
    const double still = open_for(method, 0);
    // Shorter than the clock of the animation can tell.
    for (const float seconds : {1e-12f, 1e-38f})
      lab.expect_near(method, number(seconds) + " s", open_for(method, seconds), still, 0);
    lab.expect_near(method, "0.0001 s", open_for(method, 1e-4f), still, 1e-3);
  }
}

inline constexpr Case kShutterOfNoTime{"shutter-of-no-time", Kind::parameters,
                                       "A shutter that closes as it opens shows the instant: nothing is divided by "
                                       "how long it was open",
                                       shutter_of_no_time};

}  // namespace etendue::stress
