// All integrators that support scattering media agree in pairs; each technique of bidirectional path tracing is correct
// by itself; path classes, threads and extreme media for each of them.
//
// Pairs of images are compared block by block with t-tests. The false-alarm rate is 1 % for the family of all blocks of
// all pairs of a test.
#include <gtest/gtest.h>

#include <cmath>

#include "integrator/integrator.h"
#include "statistical/media/class_sums.h"
#include "support/integrator_scenes.h"
#include "support/scattering_scenes.h"

namespace etendue {
namespace {

using render::Document;
using test::with;
using test::with_integrator;

// An integrator with a changed parameter, and its number of samples relative to `path`.
struct Form {
  const char* integrator;
  const char* parameter;
  const char* value;
  double effort;

  std::string name() const { return std::string(integrator) + ':' + parameter + '=' + value; }
  Document of(const Document& place) const {
    Document d = with_integrator(place, integrator);
    // Few long chains explore more than many short ones.
    if (integrator::find_integrator(integrator)->group == integrator::Group::markov_chain) d = with(d, "chains", "32");
    return *parameter ? with(d, parameter, value) : d;
  }
};

constexpr Form kPath{"path", "", "", 1}, kWithoutEquiangular{"path", "equiangular", "false", 1},
    kDistribution{"distribution", "branches-2", "2", 0.5}, kLight{"light", "", "", 4}, kBdpt{"bdpt", "", "", 0.5},
    kBalance{"bdpt", "heuristic", "balance", 0.5}, kMaximum{"bdpt", "heuristic", "maximum", 0.5},
    kEndsOnly{"bdpt", "reuse", "false", 4}, kPssmlt{"pssmlt", "", "", 2}, kMlt{"mlt", "", "", 4},
    kMerging{"vcm", "radius", "0.3", 0.5};

void expect_pairs_agree(const Document& place, const std::string& paths, uint32_t samples,
                        const std::vector<Form>& forms, double largest_error = 0.02) {
  std::vector<test::Estimate> estimates;
  for (const Form& form : forms) {
    Document d = form.of(place);
    d.method.paths = paths;
    estimates.push_back(
        test::replicated(d, static_cast<uint32_t>(samples * form.effort), 1000 * (estimates.size() + 2)));
  }
  const auto n = static_cast<int>(forms.size());
  for (size_t i = 0; i < forms.size(); ++i)
    for (size_t j = 0; j < i; ++j)
      test::expect_agreement(estimates[i], estimates[j], forms[i].name() + " and " + forms[j].name(), n * (n - 1) / 2);
  // The standard error of the mean of the image is bounded.
  for (size_t i = 0; i < forms.size(); ++i) {
    double sum = 0, variance = 0;
    for (size_t b = 0; b < estimates[i].mean.size(); ++b) {
      sum += estimates[i].mean[b];
      variance += estimates[i].variance[b];
    }
    EXPECT_LT(std::sqrt(variance), largest_error * sum) << forms[i].name();
  }
}

// Paths that light tracing samples, and those whose first event is specular.
constexpr const char *kSeenByLightPaths = "E[(D|G|V).*]L", *kThroughGlass = "ES.*L";

TEST(MediaPairwise, FogInTheCornellBox) {
  expect_pairs_agree(test::foggy_cornell_box(), kSeenByLightPaths, 64,
                     {kPath, kDistribution, kLight, kBdpt, kBalance, kMaximum, kEndsOnly, kPssmlt, kMlt, kMerging});
}
TEST(MediaPairwise, GlassOfMilk) {
  expect_pairs_agree(test::glass_of_milk(), kThroughGlass, 48, {kPath, kDistribution, kBdpt, kPssmlt, kMerging});
}
TEST(MediaPairwise, BesideAGlassOfMilk) {
  expect_pairs_agree(test::glass_of_milk(), kSeenByLightPaths, 32, {kPath, kLight, kBdpt});
}
TEST(MediaPairwise, StoneInMurkyWater) {
  expect_pairs_agree(test::stone_in_murky_water(), kThroughGlass, 48, {kPath, kDistribution, kBdpt, kPssmlt, kMerging});
}
// Few chains mix slowly between paths of many lengths.
TEST(MediaPairwise, MutationsBehindGlass) {
  expect_pairs_agree(test::stone_in_murky_water(), kThroughGlass, 48, {kPath, kMlt}, 0.04);
  expect_pairs_agree(with(test::glass_of_milk(), "path.max-depth", "4"), kThroughGlass, 48,
                     {kPath, {"mlt", "max-depth", "4", 4}}, 0.04);
}
TEST(MediaPairwise, SpotLightInFog) {
  expect_pairs_agree(test::spot_light_in_fog(), kSeenByLightPaths, 64,
                     {kPath, kWithoutEquiangular, kDistribution, kLight, kBdpt, kPssmlt, kMlt});
}
// Connections of light paths to a camera in fog have no bounded variance: collisions may be arbitrarily close to it.
TEST(MediaPairwise, CameraInChromaticFog) {
  expect_pairs_agree(test::camera_in_fog(), kSeenByLightPaths, 48, {kPath, kBdpt, kBalance, kMaximum, kPssmlt, kMlt});
}

// A lens that light paths hit, in fog.
TEST(MediaPairwise, WideLensInFog) {
  const Document d = with(with(test::foggy_cornell_box(), "camera.lens-radius", "1.5"), "camera.focus-distance", "8");
  expect_pairs_agree(d, kSeenByLightPaths, 48, {kPath, kLight, {"light-pure", "", "", 8}, kBdpt, kMaximum});
}

// Without one kind of techniques the others find the same paths: hits of lights, light samples, connections to the
// camera.
TEST(MediaTechniques, ReplaceEachOther) {
  const Document d = with_integrator(test::camera_in_fog(), "bdpt");
  const auto all = test::replicated(with(d, "film.paths", "E[(D|G|V).*]L"), 24, 1000);
  for (const char* techniques : {"0,*", "1,*", "*,1"})
    test::expect_agreement(
        all, test::replicated(with(with(d, "film.paths", "E[(D|G|V).*]L"), "bdpt.without", techniques), 24, 2000),
        techniques, 3);
}

// A medium with coefficients of zero equals a vacuum, with an atmosphere elsewhere that selects the general loops.
TEST(MediaSpecialCases, ClearMediumIsAVacuum) {
  const Document plain = test::balls_under_area_light();
  const Document general = test::with_clear_medium(plain);
  for (const Form& form : {kDistribution, kLight, kBdpt, kPssmlt, kMlt}) {
    Document a = form.of(plain), b = form.of(general);
    a.method.paths = b.method.paths = "E[(D|G|V).*]L";
    const auto samples = static_cast<uint32_t>(32 * form.effort);
    test::expect_agreement(test::replicated(a, samples, 1000), test::replicated(b, samples, 2000), form.name(), 5);
  }
}

TEST(MediaThreads, DoNotChangeTheImage) {
  for (const char* name : {"distribution", "light", "light-pure", "bdpt", "pssmlt", "mlt"}) {
    const Document d = with_integrator(with(test::camera_in_fog(), "camera.lens-radius", "0.2"), name);
    const film::Film one = test::rendered(d, 4, 1);
    EXPECT_TRUE(test::same_bits(one, test::rendered(d, 4, 2))) << name;
    EXPECT_TRUE(test::same_bits(one, test::rendered(d, 4, 7))) << name;
  }
}

// The path classes of a scene partition its image, sample by sample. Markov chains follow other targets.
TEST(MediaClasses, SumToTheImage) {
  for (const char* name : {"distribution", "light", "bdpt"}) {
    const Document d = with_integrator(test::camera_in_fog(), name);
    const auto parts =
        test::expect_sum_of_classes(d, {"EL", "E(D|G|S)+L", "E(D|G|S)*V(D|G|S)*L", "E(D|G|S)*V.*V.*L"}, 8, name, 2e-4f);
    EXPECT_GT(test::mean_of(parts[2]).value, 0) << name;
    EXPECT_GT(test::mean_of(parts[3]).value, 0) << name;
  }
}

TEST(MediaExtremes, AreFinite) {
  for (const MediumDescription& m :
       {test::medium(Rgb(3), Rgb(0), 1), test::medium(Rgb(3), Rgb(0), -1), test::medium(Rgb(50), Rgb(50)),
        test::medium({1e6f, 1, 0}, {0, 0, 1e6f}), test::medium({1e-30f, 0, 0})}) {
    scene::Scene scene;
    add(scene, test::sphere(1, 16, false), test::medium_boundary(m));
    add(scene, test::quad(3), test::diffuse(Rgb(0.5f)), Mat4(1));
    scene.environment.tint = Rgb(1);
    const Document d = test::document(std::move(scene), look_at({0, 1, 3}, Vec3(0), {0, 1, 0}, 0.8f), 16, 16);
    for (const auto& info : integrator::integrator_infos()) {
      if (!info.scattering_media) continue;
      Document tested = with_integrator(with(d, "camera.lens-radius", "0.2"), info.name);
      if (info.name == "photonmap") tested = with(with(tested, "photons", "1000"), "caustic-photons", "1000");
      const film::Film film = test::rendered(tested, 8);
      EXPECT_EQ(film.invalid_samples().total(), 0U) << info.name;
      EXPECT_TRUE(std::isfinite(test::mean_of(film).value)) << info.name;
    }
  }
}

// ---- Equiangular sampling.

// Light that is scattered once, beside a point light just outside of the image: equiangular sampling has at most a
// tenth of the variance of distances by transmittance.
TEST(Equiangular, ReducesTheNoiseAroundAPointLight) {
  scene::Scene scene;
  scene.atmosphere.medium = test::medium(Rgb(0.05f));
  scene::add_point_light(scene, {0, 2, -4}, 10);
  Mat4 behind(1);
  behind[3] = Vec4(0, 0, 50, 1);
  add(scene, test::quad(0.1f), test::diffuse(Rgb(0)), behind);
  const Document d = with(test::document(std::move(scene), look_at(Vec3(0), {0, 0, -1}, {0, 1, 0}, 0.8f), 16, 16),
                          "film.paths", "EVL");
  const auto plain = test::replicated(with(d, "path.equiangular", "false"), 64, 1000);
  const auto equiangular = test::replicated(d, 16, 2000);
  test::expect_agreement(plain, equiangular, "equiangular");
  double a = 0, b = 0;
  for (size_t i = 0; i < plain.mean.size(); ++i) a += 64 * plain.variance[i], b += 16 * equiangular.variance[i];
  EXPECT_LT(b, 0.1 * a);
}

}  // namespace
}  // namespace etendue
