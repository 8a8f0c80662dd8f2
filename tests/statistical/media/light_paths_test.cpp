// Media that emit and media whose density varies, in integrators that trace paths from lights, store photons, or run
// Markov chains: agreement with path tracing, techniques, threads, extreme media.
//
// Pairs of images are compared block by block with t-tests. The false-alarm rate is 1 % for the family of all blocks of
// all pairs of a test.
#include <gtest/gtest.h>

#include <cmath>

#include "integrator/integrator.h"
#include "light/environments/sky.h"
#include "render/incompatibility.h"
#include "support/integrator_scenes.h"
#include "support/resume.h"
#include "support/scattering_scenes.h"
#include "support/translation.h"

namespace etendue::media_light_paths {
namespace {

using render::Document;
using test::at;
using test::medium;
using test::medium_boundary;
using test::with;
using test::with_integrator;

// An integrator with changed parameters, and its number of samples relative to `path`.
struct Form {
  const char* integrator;
  std::vector<std::pair<const char*, const char*>> settings;
  double effort;

  std::string name() const {
    std::string text = integrator;
    for (const auto& [key, value] : settings) text += std::string(" ") + key + '=' + value;
    return text;
  }
  Document of(const Document& place) const {
    Document d = with_integrator(place, integrator);
    for (const auto& [key, value] : settings) d = with(d, (std::string(integrator) + "." + key).c_str(), value);
    return d;
  }
};

const Form kLight{"light", {}, 4}, kPure{"light-pure", {}, 16}, kBdpt{"bdpt", {}, 0.5},
    kBalance{"bdpt", {{"heuristic", "balance"}}, 0.5}, kMaximum{"bdpt", {{"heuristic", "maximum"}}, 0.5},
    kEndsOnly{"bdpt", {{"reuse", "false"}}, 8}, kChainsOfPaths{"pssmlt", {{"chains", "32"}, {"form", "path"}}, 2},
    kChains{"pssmlt", {{"chains", "32"}}, 2}, kMultiplexed{"pssmlt", {{"chains", "32"}, {"form", "multiplexed"}}, 4};

// Compares forms with path tracing.
void expect_agreement_with_path(const Document& place, const std::string& what, uint32_t samples,
                                const std::vector<Form>& forms, double largest_error = 0.03) {
  const auto reference = test::replicated(with_integrator(place, "path"), 2 * samples, 1000);
  uint64_t seed = 1000;
  for (const Form& form : forms) {
    const auto estimate = test::replicated(form.of(place), static_cast<uint32_t>(samples * form.effort), seed += 1000);
    test::expect_agreement(reference, estimate, what + ", " + form.name(), static_cast<int>(forms.size()));
    double sum = 0, variance = 0;
    for (size_t b = 0; b < estimate.mean.size(); ++b) sum += estimate.mean[b], variance += estimate.variance[b];
    EXPECT_LT(std::sqrt(variance), largest_error * sum) << what << ", " << form.name();
  }
}

// A floor and a ball, both diffuse.
scene::Scene stage() {
  scene::Scene scene;
  add(scene, test::quad(4), test::diffuse(Rgb(0.6f)));
  add(scene, test::sphere(0.5f, 24, false), test::diffuse({0.7f, 0.4f, 0.2f}), at({0.9f, 0.5f, 0.4f}));
  return scene;
}

// A flame, which is the only light.
scene::Scene flame_in_the_dark() {
  MediumDescription flame = medium(Rgb(0.5f), Rgb(3), 0.3f);
  flame.emission = Rgb(20);
  flame.temperature = 2200;
  flame.density.field = make_density("flame");
  scene::Scene scene = stage();
  add(scene, scene::box({0.4f, 0.7f, 0.4f}), medium_boundary(flame), at({-0.4f, 1, 0}));
  return scene;
}

// A ball of gas that scatters and emits.
scene::Scene glowing_gas() {
  MediumDescription gas = medium({2, 1, 0.5f}, Rgb(0.5f), 0.3f);
  gas.emission = {8, 6, 3};
  scene::Scene scene = stage();
  add(scene, test::sphere(0.5f, 24, false), medium_boundary(gas), at({-0.4f, 1.1f, 0}));
  return scene;
}

// A medium of varying density under sun and sky.
scene::Scene cloud_of(const MediumDescription& m) {
  scene::Scene scene = stage();
  add(scene, scene::box({1.2f, 0.5f, 1.2f}), medium_boundary(m), at({0, 1.6f, 0}));
  Sky sky;
  sky.sun_elevation = 0.8f;
  scene.environment = make_sky(sky);
  scene.environment.tint = Rgb(1e-4f);
  return scene;
}
MediumDescription cloud() {
  MediumDescription m = medium(Rgb(6), Rgb(0.1f), 0.5f);
  m.density.field = make_density("cloud");
  return m;
}
// With coefficients and a density that vary much.
MediumDescription chromatic() {
  MediumDescription m = medium({6, 2, 0.2f}, {0, 1, 2}, 0.3f);
  m.density.field = make_density("linear");
  return m;
}

Document seen(scene::Scene scene) {
  return test::document(std::move(scene), look_at({1, 3, 4.5f}, {0, 0.8f, 0}, {0, 1, 0}, 0.7f), test::kSize,
                        test::kSize);
}
Document with_wide_lens(const Document& d) {
  return with(with(d, "camera.lens-radius", "1"), "camera.focus-distance", "5");
}

// ---- Media that emit.

// Starts of light paths are divided between lights and media.
scene::Scene flame_and_area_light() {
  scene::Scene scene = flame_in_the_dark();
  Mat4 down = at({1.5f, 3, 0});
  down[1][1] = down[2][2] = -1;
  add(scene, test::quad(0.3f), test::diffuse(Rgb(0), Rgb(30)), down);
  return scene;
}

TEST(LightPathsFromMedia, AgreeWithPathTracing) {
  const Form progressive{"sppm", {{"photons", "3000"}, {"radius", "0.3"}, {"volume-radius", "0.02"}}, 0.75},
      photons_only{
          "sppm", {{"photons", "6000"}, {"radius", "0.5"}, {"volume-radius", "0.02"}, {"connect", "off"}}, 0.5},
      virtual_lights{"igi", {{"light-paths", "8"}, {"bound", "1"}}, 1};
  expect_agreement_with_path(seen(flame_in_the_dark()), "flame", 16,
                             {kLight, progressive, photons_only, virtual_lights});
  expect_agreement_with_path(seen(flame_in_the_dark()), "flame", 16, {kChains, kChainsOfPaths}, 0.06);
  expect_agreement_with_path(seen(glowing_gas()), "gas", 16, {kLight, progressive, virtual_lights});
  expect_agreement_with_path(seen(glowing_gas()), "gas", 16, {kChains, kMultiplexed}, 0.06);
}

// Few chains mix slowly between paths of many lengths, so that paths have at most five edges.
TEST(LightPathsFromMedia, OfMutationsAgreeWithPathTracing) {
  const Form mutations{"mlt", {{"chains", "32"}, {"max-depth", "5"}}, 4};
  const auto limited = [](const scene::Scene& scene) { return with(seen(scene), "path.max-depth", "5"); };
  expect_agreement_with_path(limited(flame_in_the_dark()), "flame", 16, {mutations}, 0.06);
  expect_agreement_with_path(limited(glowing_gas()), "gas", 16, {mutations}, 0.06);
  expect_agreement_with_path(limited(flame_and_area_light()), "flame and area light", 16, {mutations}, 0.06);
}

TEST(LightPathsFromMedia, HitALens) {
  expect_agreement_with_path(with_wide_lens(seen(flame_in_the_dark())), "flame", 16, {kLight, kPure});
}

TEST(LightPathsFromMedia, AndFromLights) {
  expect_agreement_with_path(seen(flame_and_area_light()), "flame and area light", 16,
                             {kLight, {"igi", {{"light-paths", "8"}, {"bound", "1"}}, 1}});
}

// A medium inside glass, whose light no light sample finds.
TEST(LightPathsFromMedia, LeaveGlass) {
  MediumDescription gas = medium(Rgb(0.2f), Rgb(0.5f));
  gas.emission = Rgb(8);
  scene::Scene scene = stage();
  add(scene, test::sphere(0.5f, 32, false), test::turbid_liquid(1.4f, gas), at({-0.4f, 0.7f, 0}));
  Document d = seen(scene);
  d.method.paths = "E[(D|G).*]L";
  expect_agreement_with_path(d, "gas in glass", 48, {kLight}, 0.05);
}

// Density estimation is biased, so that means over the image have a tolerance.
TEST(LightPathsFromMedia, PhotonMapsHaveTheirLight) {
  const Form direct{"photonmap", {{"mode", "direct"}, {"renew", "on"}, {"photons", "20000"}, {"nearest", "8"}}, 0.5},
      classic{"photonmap",
              {{"renew", "on"}, {"photons", "10000"}, {"caustic-photons", "10000"}, {"nearest", "8"}, {"near", "0.1"}},
              0.5};
  for (const auto& [name, scene] : {std::pair("flame", flame_in_the_dark()), std::pair("gas", glowing_gas())}) {
    const Document d = seen(scene);
    const double expected = test::mean_of(test::rendered(with_integrator(d, "path"), 256)).value;
    for (const Form& form : {direct, classic})
      EXPECT_NEAR(test::mean_of(test::rendered(form.of(d), 16)).value, expected, 0.06 * expected)
          << name << ", " << form.name();
  }
}

TEST(LightPathsFromMedia, RefuseAnAtmosphereWithoutEnd) {
  scene::Scene scene = stage();
  scene.atmosphere.medium = medium(Rgb(0.1f), Rgb(0.1f));
  scene.atmosphere.medium.emission = Rgb(1);
  const auto reason = [](const Document& d) {
    return render::incompatibility(d, *scene::compile(d.scene, d.camera, nullptr));
  };
  const Document endless = with_wide_lens(seen(scene));
  scene.atmosphere.radius = 10;
  const Document bounded = with_wide_lens(seen(scene));
  for (const char* name : {"light", "light-pure", "photonmap", "sppm", "igi", "mlt"}) {
    EXPECT_NE(reason(with_integrator(endless, name)).find("set atmosphere.radius"), std::string::npos) << name;
    EXPECT_EQ(reason(with_integrator(bounded, name)), "") << name;
  }
  EXPECT_EQ(reason(with_integrator(endless, "path")), "");
}

// ---- Media whose density varies.

TEST(HeterogeneousLightPaths, AgreeWithPathTracing) {
  for (const auto& [name, m] : {std::pair("cloud", cloud()), std::pair("chromatic", chromatic())}) {
    Document d = seen(cloud_of(m));
    d.method.paths = "E[(D|G|V).*]L";
    expect_agreement_with_path(d, name, 32, {kLight, kBdpt, kBalance, kMaximum, kEndsOnly, kChainsOfPaths, kChains});
  }
}

// Few chains mix slowly between paths of many lengths, so that paths have at most five edges.
TEST(HeterogeneousLightPaths, OfMutationsAgreeWithPathTracing) {
  const Form mutations{"mlt", {{"chains", "32"}, {"max-depth", "5"}}, 4};
  for (const auto& [name, m] : {std::pair("cloud", cloud()), std::pair("chromatic", chromatic())}) {
    Document d = with(seen(cloud_of(m)), "path.max-depth", "5");
    d.method.paths = "E[(D|G|V).*]L";
    expect_agreement_with_path(d, name, 32, {mutations});
  }
}

// A constant grid has the MIS weights of the homogeneous medium. Light paths that are connected to the camera are left
// out, because rounding changes the pixels that the filter selects.
TEST(HeterogeneousLightPaths, WeightsOfAConstantGrid) {
  const MediumDescription homogeneous = medium({0.6f, 0.3f, 0.1f}, {0, 0.1f, 0.3f}, 0.4f);
  MediumDescription constant = homogeneous;
  constant.density.field = make_density("constant");
  constant.estimator = TransmittanceEstimator::regular;
  const auto image = [](const MediumDescription& m) {
    return test::rendered(with(with_integrator(seen(cloud_of(m)), "bdpt"), "bdpt.without", "*,1"), 4);
  };
  const film::Film a = image(homogeneous), b = image(constant);
  int different = 0;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x)
      for (int c = 0; c < 3; ++c)
        if (std::abs(a.mean(x, y)[c] - b.mean(x, y)[c]) > 1e-3f * a.mean(x, y)[c] + 1e-5f) ++different;
  // Rounding sends a few paths elsewhere.
  EXPECT_LE(different, a.width() * a.height() / 50);
}

// Without one kind of techniques the others find the same paths.
TEST(HeterogeneousLightPaths, TechniquesReplaceEachOther) {
  Document d = with_integrator(seen(cloud_of(chromatic())), "bdpt");
  d.method.paths = "E[(D|G|V).*]L";
  const auto all = test::replicated(d, 16, 1000);
  for (const char* techniques : {"1,*", "*,1"})
    test::expect_agreement(all, test::replicated(with(d, "bdpt.without", techniques), 32, 2000), techniques, 2);
}

TEST(HeterogeneousLightPaths, HitALens) {
  Document d = with_wide_lens(seen(cloud_of(chromatic())));
  d.method.paths = "E[(D|G|V).*]L";
  expect_agreement_with_path(d, "chromatic", 24, {kLight, kPure, kBdpt, kMaximum});
}

// ---- Common to both.

TEST(LightPathsInMedia, DoNotDependOnThreads) {
  scene::Scene both = flame_in_the_dark();
  add(both, scene::box({1.2f, 0.3f, 1.2f}), medium_boundary(chromatic()), at({0, 2, 0}));
  for (const auto& info : integrator::integrator_infos()) {
    if (!info.heterogeneous_media) continue;
    Document d = with_integrator(with_wide_lens(seen(info.emitting_media ? both : cloud_of(chromatic()))), info.name);
    if (info.name == "photonmap") d = with(with(d, "photons", "2000"), "caustic-photons", "2000");
    const film::Film one = test::rendered(d, 2, 1);
    EXPECT_GT(test::mean_of(one).value, 0) << info.name;
    EXPECT_TRUE(test::same_bits(one, test::rendered(d, 2, 2))) << info.name;
    EXPECT_TRUE(test::same_bits(one, test::rendered(d, 2, 7))) << info.name;
  }
}

// Vertices in volumes, and lights in media, are restored from a checkpoint.
TEST(LightPathsInMedia, ChainsResume) {
  test::expect_same_bits_after_resume(with(with_integrator(seen(flame_and_area_light()), "mlt"), "chains", "16"),
                                      "mlt, flame");
  for (const char* name : {"mlt", "pssmlt"})
    test::expect_same_bits_after_resume(with(with_integrator(seen(cloud_of(chromatic())), name), "chains", "16"), name);
}

TEST(LightPathsInMedia, AreFiniteInExtremeMedia) {
  for (const auto& [coefficients, density] :
       {std::pair(medium(Rgb(50), Rgb(50)), "cloud"), std::pair(medium({1e6f, 1, 0}, {0, 0, 1e6f}), "ball"),
        std::pair(medium({1e-30f, 0, 0}), "linear")}) {
    MediumDescription m = coefficients;
    m.density.field = make_density(density);
    for (const auto& info : integrator::integrator_infos()) {
      if (!info.heterogeneous_media) continue;
      m.emission = info.emitting_media ? Rgb(10) : Rgb(0);
      Document d =
          with(with_integrator(with_wide_lens(seen(cloud_of(m))), info.name), (info.name + ".max-depth").c_str(), "64");
      if (info.name == "photonmap") d = with(with(d, "photons", "1000"), "caustic-photons", "1000");
      const film::Film film = test::rendered(d, 2);
      EXPECT_EQ(film.invalid_samples().total(), 0U) << info.name << ' ' << density;
      EXPECT_TRUE(std::isfinite(test::mean_of(film).value)) << info.name << ' ' << density;
    }
  }
}

}  // namespace
}  // namespace etendue::media_light_paths
