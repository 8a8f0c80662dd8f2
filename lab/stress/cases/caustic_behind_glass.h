// A point light above a glass sphere above a disk, seen past the sphere and through it. The caustic itself can be
// sampled from the light; its image in the sphere can only be found with photons.   [Lang, sec. 9.3.2; Jensen 1996]
#pragma once
#include "stress/case.h"

namespace etendue::stress {

inline void caustic_behind_glass(TestContext& test) {
  scene::Scene scene;
  scene::add(scene, scene::disk(0.6f, 64), scene::diffuse(Rgb(0.8f)));
  Mat4 transform(1);
  transform[3] = Vec4(0, 1, 0, 1);
  scene::add(scene, scene::sphere(0.5f, 48, false), scene::glass(), transform);
  add_point_light(scene, {0, 3, 0}, 10);
  const auto d = test.document(std::move(scene), look_at({2.5f, 2, 0}, {0, 0.5f, 0}, {0, 1, 0}, 0.7f));
  const auto mean = [&](const std::string& method, const char* paths, uint32_t samples) {
    auto filtered = TestContext::with_method(d, method);
    filtered.method.paths = paths;
    return test.mean(filtered, samples).value;
  };
  constexpr const char *kVisible = "EDS+L", *kThroughGlass = "ES+DS+L";
  const double caustic = mean("light", kVisible, 256);
  test.expect_near("bdpt", kVisible, mean("bdpt", kVisible, 256), caustic, 0.05);
  test.expect_near("pssmlt:form=bidirectional", kVisible, mean("pssmlt:form=bidirectional", kVisible, 256), caustic,
                   0.1);
  // One in a hundred large steps uses the only technique that finds the caustic, and one in sixty of these hits the
  // sphere, so chains with small steps would estimate its brightness to a third at best. Independent samples reach 12 %
  // (six seeds); the tolerance is three standard deviations.
  const std::string independent = "pssmlt:form=multiplexed:large-steps=1";
  test.expect_near(independent, kVisible, mean(independent, kVisible, 1024), caustic, 0.36);
  for (const char* method : {"bdpt", "pssmlt:form=bidirectional", "pssmlt:form=multiplexed"})
    test.expect_zero(method, kThroughGlass, mean(method, kThroughGlass, 16));
  for (const char* method : {"photonmap", "sppm"})
    test.expect_between(method, kThroughGlass, mean(method, kThroughGlass, 32), 1e-5, 1e-2);
  test.expect_zero("pssmlt:form=path", kVisible, mean("pssmlt:form=path", kVisible, 16));
}

inline constexpr Case kCausticBehindGlass{
    .name = "caustic-behind-glass",
    .kind = Kind::missing_paths,
    .theory =
        "No path sampling technique connects a point light with a pinhole through a specular, a diffuse "
        "and another specular event. This part is black except with photon maps; the directly visible "
        "caustic appears",
    .run = caustic_behind_glass};

}  // namespace etendue::stress
