// Photons and virtual lights in scattering media: closed forms, agreement with path tracing, special cases.
//
// Radii are small where images are compared by t-tests, so that the bias is below their resolution.
#include <gtest/gtest.h>

#include <cmath>

#include "integrator/photon/photon_emission.h"
#include "render/session.h"
#include "sampling/random.h"
#include "support/integrator_scenes.h"
#include "support/scattering_scenes.h"

namespace etendue {
namespace {

using render::Document;
using test::with;
using test::with_integrator;
using Settings = std::vector<std::pair<std::string, std::string>>;

// A photon integrator, or one with virtual lights, with changed parameters.
struct Variant {
  const char* integrator;
  Settings settings;

  Document of(const Document& place) const {
    Document d = with_integrator(place, integrator);
    for (const auto& [name, value] : settings)
      d = with(d, (std::string(integrator) + "." + name).c_str(), value.c_str());
    return d;
  }
  std::string name() const {
    std::string text = integrator;
    for (const auto& [key, value] : settings) text += ' ' + key + '=' + value;
    return text;
  }
};

// ---- Stored photons.

// The sum of the stored powers of one emission, by channel.
Rgb stored_in_volumes(const scene::Scene& description, int photons, uint32_t sample) {
  const Camera camera;
  const auto scene = scene::compile(std::make_shared<const scene::Scene>(description), camera, nullptr);
  const transport::Model model = transport::model_for(*scene);
  const RandomSampler sampler;
  const CameraRays rays(camera, 8, 8);
  const film::Filter filter{film::FilterKind::box};
  integrator::PhotonPlan plan;
  plan.photons = photons;
  plan.split = transport::LobeSplit(0.2f);
  plan.min_volume_length = 1;
  integrator::PhotonEmission emission(plan, sample);
  const integrator::RenderContext context{scene.get(), &model, &sampler, &rays, &filter, 1, 8, 8};
  for (int i = 0; i < plan.tasks(); ++i) emission.run(context, integrator::PhotonEmission::kTrace, i, {});
  emission.finish(integrator::PhotonEmission::kTrace);
  for (int i = 0; i < 2 * photon::PhotonMap::kPieces; ++i)
    emission.run(context, integrator::PhotonEmission::kBuild, i, {});
  emission.finish(integrator::PhotonEmission::kBuild);
  EXPECT_LE(emission.volume_map()->size(), integrator::kMostVolumePhotonsPerPath * static_cast<size_t>(photons + 512));
  Rgb sum(0);
  for (const photon::Photon& p : emission.volume_map()->photons()) sum += p.power();
  return sum;
}

// In an unbounded medium all light is absorbed: the integral of the fluence is the power over the absorption
// coefficient. 4.5 standard errors of 16 independent emissions.
TEST(VolumePhotons, SumToTheAbsorbedPower) {
  struct Case {
    Rgb scattering, absorption;
  };
  for (const auto& [scattering, absorption] :
       {Case{Rgb(1), Rgb(0.5f)}, Case{{2, 1, 0.4f}, {0.1f, 0.5f, 0.4f}}, Case{Rgb(10), Rgb(0.2f)}}) {
    scene::Scene scene;
    scene.atmosphere.medium = test::medium(scattering, absorption, 0.3f);
    scene::add_point_light(scene, {0, 0, 0}, 1);
    constexpr int kEmissions = 16;
    std::array<double, 3> sum{}, squares{};
    for (uint32_t i = 0; i < kEmissions; ++i) {
      const Rgb stored = stored_in_volumes(scene, 2000, i);
      for (size_t c = 0; c < 3; ++c) {
        const auto value = static_cast<double>(stored[static_cast<int>(c)]);
        sum[c] += value;
        squares[c] += value * value;
      }
    }
    for (size_t c = 0; c < 3; ++c) {
      const double expected = 4 * double{kPi} / static_cast<double>(absorption[static_cast<int>(c)]);
      const double mean = sum[c] / kEmissions;
      const double error = std::sqrt(std::max(squares[c] / kEmissions - mean * mean, 0.0) / (kEmissions - 1));
      EXPECT_NEAR(mean, expected, 4.5 * error + 1e-3 * expected) << c;
      EXPECT_LT(error, 0.02 * expected) << c;
    }
  }
}

// ---- Agreement with path tracing.

const Variant kDirect{"photonmap", {{"mode", "direct"}, {"renew", "on"}, {"photons", "20000"}, {"nearest", "8"}}},
    kClassic{"photonmap",
             {{"renew", "on"}, {"photons", "10000"}, {"caustic-photons", "5000"}, {"nearest", "8"}, {"near", "0.1"}}},
    kProgressive{"sppm", {{"photons", "5000"}, {"radius", "0.3"}, {"volume-radius", "0.01"}}},
    kFromPhotons{"sppm", {{"photons", "10000"}, {"radius", "0.3"}, {"volume-radius", "0.03"}, {"connect", "off"}}},
    kVirtual{"igi", {{"light-paths", "8"}, {"bound", "1"}}};

std::vector<std::pair<const char*, Document>> places() {
  return {{"fog in the Cornell box", test::foggy_cornell_box()},
          {"glass of milk", test::glass_of_milk()},
          {"stone in murky water", test::stone_in_murky_water()},
          {"spot light in fog", test::spot_light_in_fog()},
          {"camera in chromatic fog", test::camera_in_fog()}};
}

// The standard error of the mean of the image is bounded.
void expect_resolved(const test::Estimate& estimate, double largest_error, const std::string& what) {
  double sum = 0, variance = 0;
  for (size_t b = 0; b < estimate.mean.size(); ++b) sum += estimate.mean[b], variance += estimate.variance[b];
  EXPECT_LT(std::sqrt(variance), largest_error * sum) << what;
}

// t-tests over blocks; 1 % false alarms over all pairs of a test.
void expect_same_as_path(const Document& place, const std::string& name, const Variant& variant, uint32_t samples,
                         int comparisons) {
  const auto reference = test::replicated(with_integrator(place, "path"), 4 * samples, 1000);
  const auto estimate = test::replicated(variant.of(place), samples, 2000);
  test::expect_agreement(reference, estimate, name + ", " + variant.name(), comparisons);
  expect_resolved(estimate, 0.04, name + ", " + variant.name());
}

TEST(VolumePhotons, ProgressiveEqualPathTracing) {
  const auto all = places();
  for (const auto& [name, place] : all)
    expect_same_as_path(place, name, kProgressive, 12, static_cast<int>(all.size()));
}

// Virtual lights in media without a surface. Inside glass, compensation of the bound misses the light that reaches the
// second vertex through the surface.
TEST(VirtualLightsInMedia, EqualPathTracing) {
  for (const auto& [name, place] : places()) {
    const std::string place_name = name;
    if (place_name.find("fog") == std::string::npos) continue;
    expect_same_as_path(place, place_name, kVirtual, 12, 3);
  }
}

// Means over the image of light that is scattered in media first. With few photons, density estimation blurs and
// darkens by some per cent.
TEST(VolumePhotons, AreNearPathTracing) {
  const auto all = places();
  for (const size_t k : {0U, 1U}) {
    const std::string name = all[k].first;
    Document place = all[k].second;
    place.method.paths = "ES*V.*L";
    const auto reference = test::replicated(with_integrator(place, "path"), 48, 1000);
    for (const Variant& variant : {kDirect, kClassic, kFromPhotons}) {
      const auto estimate = test::replicated(variant.of(place), 4, 2000);
      double expected = 0, mean = 0;
      for (const double block : reference.mean) expected += block;
      for (const double block : estimate.mean) mean += block;
      EXPECT_NEAR(mean, expected, 0.12 * expected) << name << ", " << variant.name();
      expect_resolved(estimate, 0.05, name + ", " + variant.name());
    }
  }
}

// ---- Special cases.

// A medium with coefficients of zero equals a vacuum, with another medium elsewhere that selects the general loops.
TEST(VolumePhotons, ClearMediumIsAVacuum) {
  const Document plain = test::balls_under_area_light();
  const Document general = test::with_clear_medium(plain);
  for (Variant variant : {kClassic, kProgressive, kVirtual}) {
    // The distant ball changes the diameter of the scene, which some defaults refer to.
    if (variant.integrator == std::string("photonmap")) variant.settings.back() = {"near", "0"};
    test::expect_agreement(test::replicated(variant.of(plain), 16, 1000),
                           test::replicated(variant.of(general), 16, 2000), variant.name(), 3);
  }
}

// A medium that only scatters is invisible in a uniform sky. The tolerance of 2 % covers noise, and the error of balls
// that reach beyond the boundary.
TEST(VolumePhotons, WhiteFurnace) {
  for (const bool varies : {false, true}) {
    MediumDescription m = test::medium({2, 1, 0.5f}, Rgb(0), 0.4f);
    if (varies) m.density.field = make_density("cloud");
    scene::Scene scene;
    add(scene, test::sphere(1, 32, false), test::medium_boundary(m));
    scene.environment.tint = Rgb(1);
    const Document d = test::document(std::move(scene), look_at({0, 0, 4}, Vec3(0), {0, 1, 0}, 0.3f), 16, 16);
    for (Variant variant : {kProgressive, kFromPhotons}) {
      variant.settings.insert(variant.settings.end(), {{"photons", "50000"}, {"volume-radius", "0.01"}});
      EXPECT_NEAR(test::mean_of(test::rendered(variant.of(d), 24)).value, 1, 0.02) << variant.name() << varies;
    }
  }
}

// Each class of paths has its own light, and only that. The tolerance covers noise, and balls of gather rays that reach
// into walls.
TEST(VolumePhotons, PathClassesEqualPathTracing) {
  const Variant progressive{"sppm", {{"photons", "10000"}, {"radius", "0.5"}, {"volume-radius", "0.03"}}};
  for (const char* paths : {"EVL", "EVV.*L", "E(D|G)V.*L"}) {
    const Document d = with(test::foggy_cornell_box(), "film.paths", paths);
    const double expected = test::mean_of(test::rendered(with_integrator(d, "path"), 1024)).value;
    for (const Variant& variant : {kClassic, progressive})
      EXPECT_NEAR(test::mean_of(test::rendered(variant.of(d), 24)).value, expected, 0.2 * expected)
          << paths << ' ' << variant.name();
  }
}

TEST(VolumePhotons, ThreadsDoNotChangeTheImage) {
  Document cloud = test::camera_in_fog();
  auto scene = std::make_shared<scene::Scene>(*cloud.scene);
  for (Material& m : scene->materials)
    if (m.boundary_only) m.medium.density.field = make_density("cloud");
  cloud.scene = scene;
  for (const Document& place : {test::camera_in_fog(), cloud})
    for (const Variant& variant : {kDirect, kClassic, kProgressive, kVirtual})
      for (const char* paths : {"", "E.*V.*L"}) {
        Document d = variant.of(place);
        d.method.paths = paths;
        const film::Film one = test::rendered(d, 3, 1);
        EXPECT_GT(test::mean_of(one).value, 0) << variant.name();
        EXPECT_TRUE(test::same_bits(one, test::rendered(d, 3, 2))) << variant.name();
        EXPECT_TRUE(test::same_bits(one, test::rendered(d, 3, 7))) << variant.name();
      }
}

}  // namespace
}  // namespace etendue
