// Subsurface diffusion against the random walk in a medium, in a uniform sky: a thick slab, thin slabs and an edge,
// with equal indices of refraction (normalised diffusion) and below a boundary (dipole).
//
// The profile of a half-space counts both faces of a slab of thickness t. With the share F(t) of the light that leaves
// within the radius t, its radiance is A (2 - F(t)), which exceeds one for thin slabs. The random walk of the same mean
// free path has the single-scattering albedo that reflects A from a half-space [Chiang et al. 2016]. Below a boundary
// with the Fresnel reflectance f the radiance is f + (1 - f) A (2 - F(t)), and the random walk has the coefficients of
// which the dipole computes A.
#pragma once
#include "bsdf/diffusion/dipole_diffusion.h"
#include "bsdf/fresnel/fresnel.h"
#include "stress/case.h"

namespace etendue::stress {

namespace diffusion {

inline constexpr double kAlbedo = 0.8, kMeanFreePath = 0.05;  // m

inline constexpr float kEta = 1.3f, kReducedAlbedo = 0.99f;  // below a boundary

inline Material profile(const char* name = "subsurface", double albedo = kAlbedo) {
  Material material = scene::diffuse(Rgb(1));
  auto model = make_bsdf_model(name);
  for (const char* part : Triple::kParts) {
    model = model->with(std::string("albedo") + part, albedo);
    model = model->with(std::string("mean-free-path") + part, 1000 * kMeanFreePath);
  }
  material.model.model = model;
  return material;
}

// A medium with this single-scattering albedo.
inline Material medium(double albedo, float eta) {
  Material material = scene::glass(eta);
  material.boundary_only = eta == 1;
  material.medium.scattering = Rgb(static_cast<float>(albedo / kMeanFreePath));
  material.medium.absorption = Rgb(static_cast<float>((1 - albedo) / kMeanFreePath));
  return material;
}

inline double reduced_albedo_without_boundary() {
  return 1 - std::exp(-5.09406 * kAlbedo + 2.61188 * sqr(kAlbedo) - 4.31805 * kAlbedo * sqr(kAlbedo));
}

// The upper face of a slab of this thickness, or one of its edges.
inline render::Document slab(const TestContext& test, const Material& material, float thickness, bool edge) {
  scene::Scene scene = uniform_sky();
  scene::add(scene, scene::box({6, 0.5f * thickness, 6}), material);
  const Vec3 target(edge ? 5.99f : 0, 0.5f * thickness, 0);
  return test.document(scene, narrow_camera(target + Vec3(0.5f, 2, 0.3f), target));
}

// The share of the dipole's light that leaves beyond a radius.
inline double dipole_share_beyond(double radius, double mismatch) {
  const double sigma = std::sqrt(3 * (1 - double{kReducedAlbedo})) / kMeanFreePath;
  double beyond = 0, all = 0;
  for (const double z : {kMeanFreePath, kMeanFreePath * (1 + 4 * mismatch / 3)}) {
    const double d = std::sqrt(z * z + radius * radius);
    beyond += z / d * std::exp(-sigma * d);
    all += std::exp(-sigma * z);
  }
  return beyond / all;
}

inline std::string slab_label(double thickness) {
  return "slab of " + std::to_string(thickness / kMeanFreePath).substr(0, 4) + " mean free paths";
}

}  // namespace diffusion

inline void diffusion_with_equal_indices(TestContext& test) {
  using namespace diffusion;
  const double d = kMeanFreePath / (1.9 - kAlbedo + 3.5 * sqr(kAlbedo - 0.8));
  const auto beyond = [&](double t) { return 0.25 * std::exp(-t / d) + 0.75 * std::exp(-t / (3 * d)); };
  const Material walk = medium(reduced_albedo_without_boundary(), 1);
  for (const double thickness : {0.01, 0.1, 4.0}) {
    const auto t = static_cast<float>(thickness);
    test.expect_mean("path", slab_label(thickness) + ", normalised diffusion",
                     test.mean(slab(test, profile(), t, false), 256), kAlbedo * (1 + beyond(thickness)));
    test.expect_between("path", slab_label(thickness) + ", random walk",
                        test.mean(slab(test, walk, t, false), 64).value, kAlbedo - 0.05, 1);
  }
  test.expect_between("path", "edge, normalised diffusion", test.mean(slab(test, profile(), 4, true), 256).value,
                      kAlbedo, 2 * kAlbedo);
  test.expect_between("path", "edge, random walk", test.mean(slab(test, walk, 4, true), 64).value, kAlbedo - 0.05, 1);
}

inline void diffusion_below_a_boundary(TestContext& test) {
  using namespace diffusion;
  float refracted;
  const auto f = static_cast<double>(fresnel_dielectric(2 / std::sqrt(4 + 0.25f + 0.09f), kEta, refracted));
  const float mismatch = boundary_mismatch(kEta);
  const auto albedo = static_cast<double>(DipoleDiffusion::albedo_of(kReducedAlbedo, 1 - kReducedAlbedo, mismatch));
  const Material body = profile("dipole", albedo), walk = medium(double{kReducedAlbedo}, kEta);
  const double thick = f + (1 - f) * albedo;
  for (const double thickness : {0.01, 0.1, 4.0}) {
    const auto t = static_cast<float>(thickness);
    test.expect_mean("path", "index 1.3, " + slab_label(thickness) + ", dipole",
                     test.mean(slab(test, body, t, false), 256),
                     f + (1 - f) * albedo * (1 + dipole_share_beyond(thickness, double{mismatch})));
    // Both faces of a thin slab transmit, so that all that is not absorbed arrives.
    test.expect_between("path", "index 1.3, " + slab_label(thickness) + ", random walk",
                        test.mean(slab(test, walk, t, false), 64).value, thick - 0.05, 1);
  }
  test.expect_between("path", "index 1.3, thick slab, random walk over dipole",
                      test.mean(slab(test, walk, 4, false), 64).value / thick, 0.95, 1.05);
  test.expect_between("path", "index 1.3, edge, dipole", test.mean(slab(test, body, 4, true), 256).value, thick,
                      2 * thick);
  test.expect_between("path", "index 1.3, edge, random walk", test.mean(slab(test, walk, 4, true), 64).value,
                      thick - 0.05, 1);
}

inline void diffusion_in_a_thin_slab(TestContext& test) {
  diffusion_with_equal_indices(test);
  diffusion_below_a_boundary(test);
}

inline constexpr Case kDiffusionInAThinSlab{
    .name = "diffusion-in-a-thin-slab",
    .kind = Kind::bias,
    .theory =
        "A diffusion profile counts both faces of a thin slab and both sides of an edge, which then return more light "
        "than they receive; the random walk in a medium conserves energy",
    .run = diffusion_in_a_thin_slab};

}  // namespace etendue::stress
