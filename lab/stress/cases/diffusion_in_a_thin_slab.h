// Subsurface diffusion against the random walk in a medium, in a uniform sky: a thick slab, a thin slab and a corner.
//
// The profile of a half-space counts both faces of a slab of thickness t. With the share F(t) of the light that leaves
// within the radius t, its radiance is A (2 - F(t)), which exceeds one for thin slabs. The random walk of the same mean
// free path has the single-scattering albedo that reflects A from a half-space [Chiang et al. 2016].
#pragma once
#include "stress/case.h"

namespace etendue::stress {

namespace diffusion {

inline constexpr double kAlbedo = 0.8, kMeanFreePath = 0.05;  // m

inline Material profile() {
  Material material = scene::diffuse(Rgb(1));
  auto model = make_bsdf_model("subsurface");
  for (const char* part : Triple::kParts) {
    model = model->with(std::string("albedo") + part, kAlbedo);
    model = model->with(std::string("mean-free-path") + part, 1000 * kMeanFreePath);
  }
  material.model.model = model;
  return material;
}

inline Material medium() {
  const double albedo = 1 - std::exp(-5.09406 * kAlbedo + 2.61188 * sqr(kAlbedo) - 4.31805 * kAlbedo * sqr(kAlbedo));
  Material material = scene::glass(1);
  material.boundary_only = true;
  material.medium.scattering = Rgb(static_cast<float>(albedo / kMeanFreePath));
  material.medium.absorption = Rgb(static_cast<float>((1 - albedo) / kMeanFreePath));
  return material;
}

// The upper face of a slab of this thickness, or one of its edges.
inline render::Document slab(const TestContext& test, const Material& material, float thickness, bool edge) {
  scene::Scene scene = uniform_sky();
  scene::add(scene, scene::box({6, 0.5f * thickness, 6}), material);
  const Vec3 target(edge ? 5.99f : 0, 0.5f * thickness, 0);
  return test.document(scene, narrow_camera(target + Vec3(0.5f, 2, 0.3f), target));
}

}  // namespace diffusion

inline void diffusion_in_a_thin_slab(TestContext& test) {
  using namespace diffusion;
  const double d = kMeanFreePath / (1.9 - kAlbedo + 3.5 * sqr(kAlbedo - 0.8));
  const auto beyond = [&](double t) { return 0.25 * std::exp(-t / d) + 0.75 * std::exp(-t / (3 * d)); };
  for (const double thickness : {0.01, 0.1, 4.0}) {
    const auto t = static_cast<float>(thickness);
    const std::string label = "slab of " + std::to_string(thickness / kMeanFreePath).substr(0, 4) + " mean free paths";
    test.expect_mean("path", label + ", profile", test.mean(slab(test, profile(), t, false), 256),
                     kAlbedo * (1 + beyond(thickness)));
    test.expect_between("path", label + ", random walk", test.mean(slab(test, medium(), t, false), 64).value,
                        kAlbedo - 0.05, 1);
  }
  test.expect_between("path", "edge, profile", test.mean(slab(test, profile(), 4, true), 256).value, kAlbedo,
                      2 * kAlbedo);
  test.expect_between("path", "edge, random walk", test.mean(slab(test, medium(), 4, true), 64).value, kAlbedo - 0.05,
                      1);
}

inline constexpr Case kDiffusionInAThinSlab{
    .name = "diffusion-in-a-thin-slab",
    .kind = Kind::bias,
    .theory =
        "A diffusion profile counts both faces of a thin slab and both sides of an edge, which then return more light "
        "than they receive; the random walk in a medium conserves energy",
    .run = diffusion_in_a_thin_slab};

}  // namespace etendue::stress
