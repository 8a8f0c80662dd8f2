// Sixteen nested boxes, alternately of glass and tinted water, in front of an emitting plate.
#pragma once
#include "stress/cases/nested_glass.h"

namespace etendue::stress {

// Transmittance and reflectances of parallel layers.
struct LayerStack {
  double transmittance = 1, front_reflectance = 0, back_reflectance = 0;

  // Adds a boundary behind the layers. `inner` is the transmittance of the last layer on the way to it.
  LayerStack with_boundary(double from, double to, double inner) const {
    const double r = std::pow((from - to) / (from + to), 2);
    const double series = 1 - back_reflectance * inner * inner * r;
    const double t = transmittance;
    return {.transmittance = t * inner * (1 - r) / series,
            .front_reflectance = front_reflectance + t * t * inner * inner * r / series,
            .back_reflectance = r + (1 - r) * (1 - r) * inner * inner * back_reflectance / series};
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
    if (i % 2 == 1) {
      solid.attenuation_color = Rgb(static_cast<float>(kPerMetre));
      solid.attenuation_distance = 1;
    }
    scene::add(scene, scene::cube(half_size(i), false), solid);
  }
  add_plate(scene, 3);
  const auto transmittance = [&](int i, double metres) { return i % 2 == 1 ? std::pow(kPerMetre, metres) : 1; };
  LayerStack stack = LayerStack().with_boundary(1, index(0), 1);
  constexpr double kGap = 0.06;
  for (int i = 0; i + 1 < kSolids; ++i) stack = stack.with_boundary(index(i), index(i + 1), transmittance(i, kGap));
  const int last = kSolids - 1;
  stack = stack.with_boundary(index(last), index(last - 1), transmittance(last, 2.0 * double{half_size(last)}));
  for (int i = last - 1; i > 0; --i) stack = stack.with_boundary(index(i), index(i - 1), transmittance(i, kGap));
  stack = stack.with_boundary(index(0), 1, 1);

  const Camera camera = look_at({0.013f, 4, 0.017f}, {0.013f, 0, 0.017f}, {0, 0, 1}, 1e-4f);
  const auto d = test.document(scene, camera);
  for (const auto& method : unbiased_integrators())
    test.expect_mean(method, "", test.mean(TestContext::with_method(d, method), 256), stack.transmittance);
}

inline constexpr Case kSixteenNestedSolids{
    .name = "sixteen-nested-solids",
    .kind = Kind::geometry,
    .theory =
        "Every boundary of sixteen nested boxes refracts between the media on both sides, and every "
        "segment is attenuated by the innermost medium",
    .run = sixteen_nested_solids};

}  // namespace etendue::stress
