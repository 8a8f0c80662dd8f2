// A point light over a glass ball over a disk, seen from beside it and through the ball: the caustic itself can be
// found from the light, its image in the ball by photons alone.                                    digest 8-10: F5, F31
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void caustic_behind_glass(Lab& lab) {
  scene::Scene scene;
  scene::add(scene, scene::disk(0.6f, 64), scene::diffuse(Rgb(0.8f)));
  Mat4 place(1);
  place[3] = Vec4(0, 1, 0, 1);
  scene::add(scene, scene::sphere(0.5f, 48, false), scene::glass(), place);
  add_point_light(scene, {0, 3, 0}, 10);
  const auto d = lab.document(std::move(scene), look_at({2.5f, 2, 0}, {0, 0.5f, 0}, {0, 1, 0}, 0.7f));
  const auto mean = [&](const std::string& method, const char* paths, uint32_t samples) {
    auto shown = Lab::with_method(d, method);
    shown.method.paths = paths;
    return lab.mean(shown, samples).value;
  };
  constexpr const char *kSeen = "EDS+L", *kSeenThroughGlass = "ES+DS+L";
  const double caustic = mean("light", kSeen, 256);
  lab.expect_near("bdpt", kSeen, mean("bdpt", kSeen, 256), caustic, 0.05);
  lab.expect_near("pssmlt:form=bidirectional", kSeen, mean("pssmlt:form=bidirectional", kSeen, 256), caustic, 0.1);
  // One in a hundred large steps tries the one technique that finds it, and one in sixty of these meets the ball:
  // chains of small steps would know its brightness by a third at best. Independent samples do to 12 % here, by six
  // seeds: three standard deviations.
  const std::string independent = "pssmlt:form=multiplexed:large-steps=1";
  lab.expect_near(independent, kSeen, mean(independent, kSeen, 1024), caustic, 0.36);
  for (const char* method : {"bdpt", "pssmlt:form=bidirectional", "pssmlt:form=multiplexed"})
    lab.expect_zero(method, kSeenThroughGlass, mean(method, kSeenThroughGlass, 16));
  for (const char* method : {"photonmap", "sppm"})
    lab.expect_between(method, kSeenThroughGlass, mean(method, kSeenThroughGlass, 32), 1e-5, 1e-2);
  lab.expect_zero("pssmlt:form=path", kSeen, mean("pssmlt:form=path", kSeen, 16));
}

inline constexpr Case kCausticBehindGlass{
    "caustic-behind-glass", Kind::missing_paths,
    "No technique makes a path from a point light through glass onto something and through glass to a pinhole: that "
    "part is black unless photons are laid down there, while the caustic itself appears",
    caustic_behind_glass};

}  // namespace etendue::stress
