// A shutter that closes at the instant at which it opens.   [Lang, sec. 8.4.3.3]
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void shutter_of_no_time(TestContext& test) {
  scene::Scene scene = uniform_sky();
  const int ball = scene::add(scene, scene::sphere(0.5f, 24, false), scene::diffuse(Rgb(0)));
  scene::AnimationChannel channel;
  channel.node = ball;
  channel.times = {0, 1};
  channel.values = {-1, 0, 0, 1, 0, 0};
  auto animation = std::make_shared<scene::Animation>();
  animation->channels.push_back(channel);
  scene.animations.push_back(std::move(animation));
  scene.time = 0.5f;
  const auto d = test.document(std::move(scene), look_at({0, 0, 4}, {0, 0, 0}, {0, 1, 0}, 1));
  const auto mean_for = [&](const std::string& method, float seconds) {
    auto blurred = TestContext::with_method(d, method);
    blurred.camera.shutter = seconds;
    return test.mean(blurred, 64).value;
  };
  for (const auto& method : unbiased_integrators()) {
    const double still = mean_for(method, 0);
    // Below the resolution of the animation time.
    for (const float seconds : {1e-12f, 1e-38f})
      test.expect_near(method, number(seconds) + " s", mean_for(method, seconds), still, 0);
    test.expect_near(method, "0.0001 s", mean_for(method, 1e-4f), still, 1e-3);
  }
}

inline constexpr Case kShutterOfNoTime{
    .name = "shutter-of-no-time",
    .kind = Kind::parameters,
    .theory =
        "An exposure of zero duration shows the scene at that instant, without a division by the "
        "duration",
    .run = shutter_of_no_time};

}  // namespace etendue::stress
