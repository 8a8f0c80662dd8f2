// Sixteen boxes in each other, of glass and tinted water in turns, before a plate of light.
#pragma once
#include "stress/cases/nested_glass.h"

namespace etendue::stress {

// A stack of layers: what passes, and what each side reflects.
struct LayerStack {
  double passed = 1, front = 0, back = 0;

  // With one more medium behind it, of which `left` remains on the way to the next boundary.
  LayerStack with_boundary(double from, double to, double left) const {
    const double r = std::pow((from - to) / (from + to), 2), echo = 1 - back * left * left * r;
    return {passed * left * (1 - r) / echo, front + passed * passed * left * left * r / echo,
            r + (1 - r) * (1 - r) * left * left * back / echo};
  }
};

inline void sixteen_nested_solids(TestContext& test) {
  constexpr int kSolids = 16;
  constexpr double kGlass = 1.5, kWater = 1.33, kPerMetre = 0.8;
  const auto index = [](int i) { return i % 2 == 0 ? kGlass : kWater; };
  const auto half_size = [](int i) { return 1 - static_cast<float>(i) * 0.06f; };
  scene::Scene scene;
  for (int i = 0; i < kSolids; ++i) {
    Material solid = scene::glass(static_cast<float>(index(i)));
    if (i % 2 == 1) solid.attenuation_color = Rgb(static_cast<float>(kPerMetre)), solid.attenuation_distance = 1;
    scene::add(scene, scene::cube(half_size(i), false), solid);
  }
  add_plate(scene, 3);
  const auto left = [&](int i, double metres) { return i % 2 == 1 ? std::pow(kPerMetre, metres) : 1; };
  LayerStack stack = LayerStack().with_boundary(1, index(0), 1);
  constexpr double kGap = 0.06;
  for (int i = 0; i + 1 < kSolids; ++i) stack = stack.with_boundary(index(i), index(i + 1), left(i, kGap));
  const int last = kSolids - 1;
  stack = stack.with_boundary(index(last), index(last - 1), left(last, 2.0 * double{half_size(last)}));
  for (int i = last - 1; i > 0; --i) stack = stack.with_boundary(index(i), index(i - 1), left(i, kGap));
  stack = stack.with_boundary(index(0), 1, 1);

  const Camera camera = look_at({0.013f, 4, 0.017f}, {0.013f, 0, 0.017f}, {0, 0, 1}, 1e-4f);
  const auto d = test.document(scene, camera);
  for (const auto& method : unbiased_integrators())
    test.expect_mean(method, "", test.mean(TestContext::with_method(d, method), 1024), stack.passed);
}

inline constexpr Case kSixteenNestedSolids{"sixteen-nested-solids", Kind::geometry,
                                           "Each boundary of sixteen boxes in each other is one between its two media, "
                                           "and each segment has the attenuation of "
                                           "the innermost",
                                           sixteen_nested_solids};

}  // namespace etendue::stress
