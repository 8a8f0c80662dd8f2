// Photon mapping, with a fixed photon map and progressive, against closed forms and path tracing [Lang, sec. 9.5;
// Jensen 1996; Hachisuka and Jensen 2009].
#include <gtest/gtest.h>

#include <cmath>

#include "integrator/photon/photon_emission.h"
#include "sampling/random.h"
#include "support/integrator_scenes.h"

namespace etendue::photon_test {
namespace {

using test::with;

render::Document with_integrator(const render::Document& d, const std::string& integrator,
                                 const std::vector<std::pair<std::string, std::string>>& settings = {}) {
  render::Document made = test::with_integrator(d, integrator);
  for (const auto& [name, value] : settings) made = with(made, (integrator + "." + name).c_str(), value);
  return made;
}

// One emission pass without a renderer.
class Emitted {
 public:
  Emitted(const scene::Scene& scene, integrator::PhotonPlan plan, const std::string& paths = "")
      : scene_(scene::compile(std::make_shared<const scene::Scene>(scene), camera_, nullptr)),
        model_(transport::model_for(*scene_, {}, paths)),
        rays_(camera_, 8, 8),
        emission_(plan, 0) {
    const integrator::RenderContext context{scene_.get(), &model_, &sampler_, &rays_, &filter_, 1, 8, 8};
    for (int i = 0; i < plan.tasks(); ++i) emission_.run(context, integrator::PhotonEmission::kTrace, i, {});
    emission_.finish(integrator::PhotonEmission::kTrace);
    for (int i = 0; i < photon::PhotonMap::kPieces; ++i)
      emission_.run(context, integrator::PhotonEmission::kBuild, i, {});
    emission_.finish(integrator::PhotonEmission::kBuild);
  }

  std::vector<photon::Photon> photons() const { return emission_.map().photons(); }
  double power() const {
    double sum = 0;
    for (const auto& p : photons()) sum += double{average(p.power())};
    return sum;
  }

 private:
  Camera camera_;
  std::shared_ptr<const scene::CompiledScene> scene_;
  transport::Model model_;
  RandomSampler sampler_;
  CameraRays rays_;
  film::Filter filter_{film::FilterKind::box};
  integrator::PhotonEmission emission_;
};

integrator::PhotonPlan plan_of(int photons) {
  integrator::PhotonPlan plan;
  plan.photons = photons;
  plan.split = transport::LobeSplit(0.2f);
  return plan;
}

// Every hit of a diffuse surface is stored: 1 / (1 - rho) per emitted photon, each of power Phi / n. The number of
// photons per path is geometrically distributed with variance rho / (1 - rho)^2.
TEST(Photons, StoredInAnIntegratingSphere) {
  constexpr double kShare = 0.02;
  constexpr int kPhotons = 20'000;
  for (const float albedo : {0.5f, 0.8f}) {
    const Emitted emitted(scene::integrating_sphere(kShare, albedo), plan_of(kPhotons));
    const double stored = 1 / (1 - double{albedo}), n = kPhotons;
    EXPECT_NEAR(static_cast<double>(emitted.photons().size()) / n, stored,
                4.5 * std::sqrt(double{albedo} / n) * stored);
    const double flux = double{kPi} * 4 * double{kPi} * kShare;
    for (const auto& p : emitted.photons()) ASSERT_NEAR(average(p.power()) * n, flux, 2e-3 * flux);
    EXPECT_NEAR(emitted.power() / flux, stored, 5 * std::sqrt(double{albedo} / n) * stored);
  }
}

// Russian roulette by albedo [Lang, eq. 9.126 and Example 9.5, corrected]: a glaze of reflectance 0.25 over a base of
// albedo 0.5 at normal incidence, below a surface that catches the reflected photons. Half of the photons continue
// diffusely, a quarter specularly, a quarter is absorbed. All of them are stored.
TEST(Photons, RouletteSplitsByAlbedo) {
  scene::Scene scene;
  Material glazed;
  glazed.metallic = 0;
  glazed.roughness = 0;
  glazed.ior = 3;
  glazed.base_color = Rgb(0.5f / 0.75f);
  test::add(scene, test::quad(10), glazed);
  Mat4 above(1);
  above[3] = Vec4(0, 100, 0, 1);
  test::add(scene, test::quad(1000), test::diffuse(Rgb(1e-6f)), above);
  const Light spot = make_light("spot", {{"outer-cone", 0.01}});
  scene::Transform downwards;
  downwards.translation = {0, 50, 0};
  downwards.rotation = {-std::sqrt(0.5f), 0, 0, std::sqrt(0.5f)};
  test::add(scene, spot, downwards);
  constexpr int kPhotons = 40'000;
  const Emitted emitted(scene, plan_of(kPhotons));
  double floor = 0, mirrored = 0, diffuse = 0;
  for (const auto& p : emitted.photons()) {
    if (p.position().y < 1)
      ++floor;
    else if (std::hypot(p.position().x, p.position().z) < 5)
      ++mirrored;
    else
      ++diffuse;
  }
  const double n = kPhotons, sigma = std::sqrt(0.25 / n);
  EXPECT_NEAR(floor / n, 1, 2e-3);  // single precision moves some photons of so narrow a cone beyond its edge
  EXPECT_NEAR(mirrored / n, 0.25, 4.5 * sigma + 3e-3);  // some diffuse photons go straight up
  EXPECT_NEAR(diffuse / n, 0.5, 4.5 * sigma + 1.5e-2);  // some miss the plate
}

scene::Scene ball_over_a_floor(const Material& material) {
  scene::Scene scene;
  test::add(scene, test::quad(2), test::diffuse(Rgb(0.5f)));
  Mat4 place(1);
  place[3] = Vec4(0, 1, 0, 1);
  test::add(scene, test::sphere(0.5f, 32, false), material, place);
  test::add_point_light(scene, {0, 3, 0}, 10);
  return scene;
}

TEST(Photons, CausticPhotonsHaveSpecularPathsOnly) {
  integrator::PhotonPlan plan = plan_of(20'000);
  plan.caustics = true;
  plan.min_length = 2;
  const Emitted through(ball_over_a_floor(scene::glass()), plan);
  EXPECT_GT(through.photons().size(), 200U);
  for (const auto& p : through.photons()) {
    EXPECT_GE(p.length(), 2);
    EXPECT_LT(p.position().y, 1e-3f);
  }
  // Seen from the camera, the class of all of them is DS+L; the class restriction loses none.
  EXPECT_EQ(Emitted(ball_over_a_floor(scene::glass()), plan, "E.*DS+L").photons().size(), through.photons().size());
  EXPECT_EQ(Emitted(ball_over_a_floor(scene::glass()), plan, "E.*DDL").photons().size(), 0U);
  EXPECT_EQ(Emitted(ball_over_a_floor(test::diffuse(Rgb(0.9f))), plan).photons().size(), 0U);
}

// L = rho a / (1 - rho). Density estimation on a sphere has no boundary or topological bias. The tolerance of 2 %
// covers the noise of the map and the tessellation.
TEST(PhotonMapping, IntegratingSphere) {
  const auto d = test::integrating_sphere(0.05, 0.5f, scene::Cap::reflecting, 32);
  const double expected = 0.5 * 0.05 / 0.5;
  for (const char* mode : {"direct", "classic"}) {
    const auto made =
        with_integrator(d, "photonmap", {{"mode", mode}, {"photons", "40000"}, {"renew", "on"}, {"nearest", "40"}});
    EXPECT_NEAR(test::mean_of(test::rendered(made, 8)).value, expected, 0.02 * expected) << mode;
  }
  for (const char* connect : {"on", "off"}) {
    const auto made = with_integrator(d, "sppm", {{"connect", connect}, {"photons", "20000"}});
    EXPECT_NEAR(test::mean_of(test::rendered(made, 16)).value, expected, 0.02 * expected) << connect;
  }
}

render::Document room(int size) {
  auto d = test::cornell(size);
  d.filter = film::FilterKind::box;
  return d;
}

double mean_of(const render::Document& d, uint32_t samples) { return test::mean_of(test::rendered(d, samples)).value; }

// Each class of paths has its own light, and only that.
TEST(PhotonMapping, EachPathClassEqualsPathTracing) {
  auto d = *render::new_document("cornell-spheres");
  d.width = d.height = 24;
  for (const char* paths : {"ED.*L", "ESD.*L", "EDL", "EDDL", "E.*DS+L"}) {
    const auto filtered = with(d, "film.paths", paths);
    const double expected = mean_of(with_integrator(filtered, "bdpt"), 128);
    const double tolerance = 0.08 * expected;
    for (const char* mode : {"direct", "classic"})
      EXPECT_NEAR(mean_of(with_integrator(filtered, "photonmap",
                                          {{"mode", mode},
                                           {"renew", "on"},
                                           {"photons", "20000"},
                                           {"caustic-photons", "20000"},
                                           {"nearest", "20"}}),
                          8),
                  expected, tolerance)
          << paths << ' ' << mode;
    EXPECT_NEAR(mean_of(with_integrator(filtered, "sppm", {{"photons", "10000"}, {"radius", "0.7"}}), 64), expected,
                tolerance)
        << paths;
  }
}

// A glossy floor whose base and coat are estimated from the same photons.
TEST(PhotonMapping, ScatteringTypesOfOneSurfaceEqualPathTracing) {
  scene::Scene scene;
  Material glazed;
  glazed.metallic = 0;
  glazed.roughness = 0.6f;
  glazed.ior = 2;
  glazed.base_color = Rgb(0.4f);
  test::add(scene, test::quad(4), glazed);
  Mat4 above(1);
  above[1][1] = -1;
  above[2][2] = -1;
  above[3] = Vec4(0, 2, -1, 1);
  test::add(scene, test::quad(0.5f), test::diffuse(Rgb(0), Rgb(5)), above);
  const auto d = test::document(scene, look_at({0, 2, 3}, {0, 0, 0}, {0, 1, 0}, 0.3f), 24, 24);
  for (const char* paths : {"EDL", "EGL", "E(D|G)L"}) {
    const auto filtered = with(d, "film.paths", paths);
    const double expected = mean_of(with_integrator(filtered, "path"), 64);
    EXPECT_NEAR(mean_of(with_integrator(filtered, "photonmap", {{"mode", "direct"}, {"renew", "on"}}), 8), expected,
                0.03 * expected)
        << paths;
    EXPECT_NEAR(mean_of(with_integrator(filtered, "sppm", {{"connect", "off"}, {"photons", "20000"}}), 16), expected,
                0.03 * expected)
        << paths;
  }
}

// Direct visualisation of the map darkens the room by some per cent near its edges (boundary bias, [Lang, Remark
// 9.32]). Final gathering does not.
TEST(PhotonMapping, FinalGatheringHasNoBoundaryBias) {
  const double expected = mean_of(with_integrator(room(32), "path"), 512);
  const std::vector<std::pair<std::string, std::string>> few{{"photons", "20000"}, {"radius", "0"}};
  auto direct = few, classic = few;
  direct.emplace_back("mode", "direct");
  classic.emplace_back("mode", "classic");
  const double dark = mean_of(with_integrator(room(32), "photonmap", direct), 8) / expected;
  EXPECT_LT(dark, 0.98);
  EXPECT_NEAR(mean_of(with_integrator(room(32), "photonmap", classic), 16) / expected, 1, 0.015);
}

double squared_error(const film::Film& film, const film::Film& reference) {
  double sum = 0;
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x)
      sum += sqr(double{luminance(film.mean(x, y))} - double{luminance(reference.mean(x, y))});
  return sum;
}

// A point light of intensity one, a metre above a floor of albedo 1/2.
scene::Scene lit_floor() {
  scene::Scene scene;
  test::add(scene, test::quad(4), test::diffuse(Rgb(0.5f)));
  test::add_point_light(scene, {0, 1, 0}, 1);
  return scene;
}

// With photons^beta photons in the estimate, the squared error falls as photons^-min(beta, 2 - 2 beta) for smooth
// lighting, or as photons^-beta while the variance dominates [Lang, Remark 9.33]. A fixed number in the estimate (beta
// = 0) keeps its noise.
TEST(PhotonMapping, ErrorFallsWithPhotons) {
  auto d = test::document(lit_floor(), look_at({0, 3, 0.1f}, {0, 0, 0}, {0, 1, 0}, 0.6f), 16, 16);
  const auto reference = test::rendered(with_integrator(d, "path"), 256);
  const auto error = [&](const char* beta, int photons) {
    double sum = 0;
    for (d.seed = 0; d.seed < 4; ++d.seed)
      sum += squared_error(test::rendered(with_integrator(d, "photonmap",
                                                          {{"mode", "direct"},
                                                           {"radius", "0"},
                                                           {"nearest", "100"},
                                                           {"beta", beta},
                                                           {"photons", std::to_string(photons)}}),
                                          4),
                           reference);
    return sum;
  };
  const auto slope = [&](const char* beta) {
    return std::log(error(beta, 160'000) / error(beta, 10'000)) / std::log(16.0);
  };
  EXPECT_GT(slope("0"), -0.2);
  EXPECT_NEAR(slope("0.3333"), -0.333, 0.15);
  EXPECT_LT(slope("0.6667"), -0.5);
  EXPECT_LT(slope("0.9"), -0.15);
}

// At a point light of intensity I and height h, the mean irradiance over a disc of radius r below it is 2 I (1 - h / d)
// / r^2 with d^2 = h^2 + r^2. The expected mean over samples is therefore known, including the bias.
TEST(ProgressivePhotonMapping, BiasFallsAsTheRadiusShrinks) {
  // One pixel of a hundredth of a radian at a distance of two metres. A radius of 40 pixels is 0.8 m.
  auto d = test::document(lit_floor(), look_at({0.8f, 2 * 0.9165f, 0}, {0, 0, 0}, {0, 1, 0}, 0.01f), 1, 1);
  const double distance = std::hypot(0.8, 2 * 0.9165);
  for (const uint32_t samples_per_half : {1U, 8U, 64U}) {
    const auto made =
        with_integrator(d, "sppm", {{"connect", "off"}, {"radius", "40"}, {"photons", "20000"}, {"alpha", "0.5"}});
    double expected = 0, shrunk = 1;
    for (uint32_t i = 1; i <= samples_per_half; ++i) {
      const double r2 = shrunk * sqr(40 * 0.01 * distance);
      expected += 0.5 / double{kPi} * 2 * (1 - 1 / std::sqrt(1 + r2)) / r2 / samples_per_half;
      shrunk *= (i + 0.5) / (i + 1);
    }
    // About a hundred photons in each disc.
    EXPECT_NEAR(mean_of(made, 2 * samples_per_half), expected,
                (0.09 / std::sqrt(2 * samples_per_half) + 2e-3) * expected)
        << samples_per_half;
    EXPECT_LT(expected, 0.5 / double{kPi});
  }
}

TEST(ProgressivePhotonMapping, ConvergesTowardsPathTracing) {
  const auto reference = test::rendered(with_integrator(room(24), "path"), 4096);
  const auto error = [&](uint32_t samples) {
    return squared_error(
        test::rendered(with_integrator(room(24), "sppm", {{"photons", "4000"}, {"radius", "1"}}), samples), reference);
  };
  const double few = error(8), many = error(128);
  EXPECT_LT(many, few / 4);
}

// The photon map does not depend on the camera and is reused when the camera moves.
TEST(PhotonMapping, MapIsReusedForANewCamera) {
  render::Session session({.threads = 2});
  auto d = with_integrator(room(16), "photonmap", {{"photons", "50000"}});
  d.limits = {2, 0, 0};
  const auto rays = [&](const render::Document& document) {
    session.submit(document);
    session.finish();
    return session.status().rays;
  };
  const uint64_t first = rays(d);
  EXPECT_GT(first, 100'000U);
  auto moved = d;
  moved.camera.to_world[3].x += 0.01f;
  EXPECT_LT(rays(moved), first / 10);
  render::Session fresh({.threads = 1});
  fresh.submit(moved);
  fresh.finish();
  const auto a = fresh.film_copy(), b = session.film_copy();
  EXPECT_TRUE(test::same_bits(a, b));
  EXPECT_LT(rays(with(moved, "photonmap.nearest", "50")), first / 10);
  EXPECT_GT(rays(with(moved, "photonmap.photons", "50001")), first / 2);
  moved.seed = 7;
  EXPECT_GT(rays(moved), first / 2);
  auto repainted = *moved.scene;
  repainted.materials[0].base_color = Rgb(0.1f);
  moved.scene = std::make_shared<const scene::Scene>(std::move(repainted));
  EXPECT_GT(rays(moved), first / 2);
}

}  // namespace
}  // namespace etendue::photon_test
