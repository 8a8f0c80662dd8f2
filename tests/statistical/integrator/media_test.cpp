// Media along paths: attenuation, refraction between solids that are nested, touch or overlap, and the camera and
// lights inside solids. Closed forms, for every integrator that samples the paths in question.
//
// Means are compared within 4.5 standard errors: one false alarm in 150,000 comparisons of normal means. Comparisons of
// images use expect_agreement, which states its own rate.
#include <gtest/gtest.h>

#include <cmath>

#include "integrator/integrator.h"
#include "stress/test_context.h"
#include "support/independent_estimates.h"
#include "support/media_scenes.h"
#include "support/moving_scenes.h"
#include "support/resume.h"
#include "support/translation.h"

namespace etendue::media_test {
namespace {

using render::Document;
using test::at;
using test::liquid;
using test::with;
using test::with_integrator;

constexpr float kWater = 1.33f, kGlass = 1.5f, kDense = 1.8f;

// Adds a plate of radiance 10 that faces up, `depth` metres below the origin.
void add_plate(scene::Scene& scene, float depth, float half_size = 1) {
  add(scene, test::quad(half_size), test::diffuse(Rgb(0), Rgb(10)), at({0, -depth, 0}));
}

// A camera whose pixels all see one point straight below.
Document looking_down(scene::Scene scene, float height) {
  Camera camera = look_at({0.013f, height, 0.017f}, {0.013f, height - 1, 0.017f}, {0, 0, 1}, 1e-4f);
  return test::document(std::move(scene), camera, 16, 16);
}

// Whitted's integrator ends branches of small throughput and limits their length, which biases its image. Here the limits
// are 1e-6 and 1000 rather than 1e-3 and 16.
Document without_cutoff(const Document& d) {
  return d.method.integrator == "whitted" ? with(with(d, "whitted.threshold", "0.000001"), "whitted.max-depth", "1000")
                                          : d;
}

// The mean within 4.5 standard errors, which are at most 2 % of it. The second term of the margin is for rounding and for
// paths beyond the maximum length. Pixels of Markov chains are correlated: their standard error is that of twelve seeds.
void expect_mean(const Document& document, uint32_t samples, double expected) {
  const Document d = without_cutoff(document);
  double value = 0, standard_error = 0;
  if (d.method.integrator == "mlt" || d.method.integrator == "pssmlt") {
    const test::Estimate estimate = test::replicated([&](uint64_t seed) {
      Document other = d;
      other.seed = seed;
      return test::Blocks{test::mean_of(test::rendered(other, samples / 4)).value};
    });
    value = estimate.mean[0];
    standard_error = std::sqrt(estimate.variance[0]);
  } else {
    const test::Mean mean = test::mean_of(test::rendered(d, samples));
    value = mean.value;
    standard_error = mean.standard_error;
  }
  EXPECT_NEAR(value, expected, 4.5 * standard_error + 2e-4 * expected) << d.method.integrator;
  EXPECT_LT(standard_error, 0.02 * expected) << d.method.integrator;
}

// ---- Attenuation.

// Integrators that find a light through smooth boundaries.
std::vector<std::string> see_through_glass() {
  std::vector<std::string> names = stress::unbiased_integrators();
  names.insert(names.end(), {"whitted", "photonmap", "sppm", "vcm", "igi", "mlt"});
  return names;
}

// The segment that is attenuated ends on a light in the water, not on the boundary of the water.
TEST(Attenuation, OfAnEmitterInWater) {
  scene::Scene scene;
  add(scene, scene::box({2, 2, 2}), liquid(1, Rgb(0.5f)), at({0, -2, 0}));
  add_plate(scene, 2);
  for (const std::string& name : see_through_glass())
    expect_mean(with_integrator(looking_down(scene, 3), name), 64, 2.5);
}

// A camera in the water, for all integrators.
TEST(Attenuation, FromACameraInWater) {
  scene::Scene scene;
  add(scene, scene::box({2, 3, 2}), liquid(kWater, Rgb(0.5f)));
  add_plate(scene, 2);
  for (const auto& info : integrator::integrator_infos()) {
    Document d = with_integrator(looking_down(scene, 0), info.name);
    // Light paths do not reach a pinhole, or not a view of a single point; see UpToTheLens. Radiosity refuses media.
    if (info.name == "light-pure" || info.name == "light" || info.name == "radiosity") continue;
    d = with(d, "film.paths", "EL");
    expect_mean(d, 64, 2.5);
    // Attenuation ends at the near plane.
    Document cut = d;
    cut.camera.near_clip = 1;
    expect_mean(cut, 64, 5);
  }
}

// Reflection in water: 1 m from the light to the floor and 2 m from there to the camera.
TEST(Attenuation, OfDirectLight) {
  scene::Scene scene;
  add(scene, scene::box({4, 4, 4}), liquid(kWater, {0.5f, 0.25f, 1}));
  add(scene, test::quad(3), test::diffuse(Rgb(0.5f)), at({0, -2, 0}));
  test::add_point_light(scene, {0.013f, -1, 0.017f}, 4);
  for (const char* name :
       {"path", "distribution", "whitted", "appel", "bdpt", "pssmlt", "mlt", "igi", "sppm", "vcm", "photonmap"}) {
    Document d = with(with_integrator(looking_down(scene, 0), name), "film.paths", "EDL");
    const auto film = test::rendered(d, 64);
    const Rgb mean = test::mean_color(film);
    const float clear = 4 * 0.5f / kPi;
    EXPECT_NEAR(mean.r / (clear * 0.125f), 1, 0.02) << name;
    EXPECT_NEAR(mean.g / (clear * 0.015625f), 1, 0.02) << name;
    EXPECT_NEAR(mean.b / clear, 1, 0.02) << name;
  }
}

// Photons and virtual lights behind water, and lookups under water.
TEST(Attenuation, OfIndirectLight) {
  const Document d = with(test::light_in_tinted_water(true), "film.paths", "ED(D|G)*L");
  const double expected = test::mean_of(test::rendered(with_integrator(d, "path"), 512)).value;
  for (const char* name : {"sppm", "photonmap", "igi"}) {
    Document other = with_integrator(d, name);
    if (std::string(name) == "photonmap") other = with(other, "photonmap.gather", "8");
    EXPECT_NEAR(test::mean_of(test::rendered(other, 128)).value / expected, 1, 0.05) << name;
  }
}

// Nested and overlapping solids without refraction: every metre is attenuated by the medium of the highest priority.
TEST(Attenuation, OfTheMediumOfHighestPriority) {
  scene::Scene nested;
  add(nested, scene::cube(1, false), liquid(1, Rgb(0.6f)));
  add(nested, scene::cube(0.5f, false), liquid(1, Rgb(0.3f)));
  // A wall from 0 to -1 m and a liquid from -0.6 to -2 m, either of which is the smaller box.
  const auto overlapping = [](float wall_size, float liquid_size) {
    scene::Scene scene;
    add(scene, scene::box({wall_size, 0.5f, wall_size}), liquid(1, Rgb(0.5f)), at({0, -0.5f, 0}));
    add(scene, scene::box({liquid_size, 0.7f, liquid_size}), liquid(1, Rgb(0.8f)), at({0, -1.3f, 0}));
    return scene;
  };
  struct {
    scene::Scene scene;
    double transmittance;
  } cases[] = {{nested, 0.6 * 0.3},
               {overlapping(2, 1), std::pow(0.5, 0.6) * std::pow(0.8, 1.4)},
               {overlapping(1, 2), 0.5 * 0.8}};
  for (auto& [scene, transmittance] : cases) {
    add_plate(scene, 3);
    for (const std::string& name : see_through_glass())
      expect_mean(with_integrator(looking_down(scene, 3), name), 64, 10 * transmittance);
  }
}

// Light that reaches a lens in water is attenuated up to the lens, not beyond it.
TEST(Attenuation, UpToTheLens) {
  scene::Scene scene;
  add(scene, scene::box({2, 3, 2}), liquid(kWater, Rgb(0.3f)));
  add_plate(scene, 1, 1.5f);
  Document d = test::document(std::move(scene), look_at({0, 0, 0}, {0, -1, 0}, {0, 0, 1}, 0.5f), 16, 16);
  d.camera.lens_radius = 0.4f;
  d.camera.focus_distance = 1;
  const test::Mean path = test::mean_of(test::rendered(with(with_integrator(d, "path"), "film.paths", "EL"), 256));
  for (const char* name : {"light-pure", "bdpt", "light"}) {
    const test::Mean mean = test::mean_of(test::rendered(with(with_integrator(d, name), "film.paths", "EL"), 1024));
    EXPECT_NEAR(mean.value, path.value, 4.5 * (mean.standard_error + path.standard_error)) << name;
    EXPECT_LT(mean.standard_error, 0.05 * path.value) << name;
  }
}

// ---- Refraction between media.

double reflectance(double a, double b) { return std::pow((a - b) / (a + b), 2); }

// The transmittance of parallel lossless boundaries with all reflections between them: their ratios R / T add up.
double transmission_of(const std::vector<double>& indices) {
  double ratio = 0;
  for (size_t i = 1; i < indices.size(); ++i) {
    const double r = reflectance(indices[i - 1], indices[i]);
    ratio += r / (1 - r);
  }
  return 1 / (1 + ratio);
}

TEST(Refraction, OfBoxesInEachOther) {
  scene::Scene scene;
  add(scene, scene::cube(1, false), liquid(kWater));
  add(scene, scene::cube(0.8f, false), liquid(kDense));
  add(scene, scene::cube(0.5f, false), liquid(1));
  add_plate(scene, 3);
  const double expected = 10 * transmission_of({1, kWater, kDense, 1, kDense, kWater, 1});
  for (const std::string& name : see_through_glass())
    expect_mean(with_integrator(looking_down(scene, 3), name), 128, expected);
}

// Touching faces are one interface.
TEST(Refraction, OfBoxesSideBySide) {
  scene::Scene scene;
  add(scene, scene::cube(1, false), liquid(kDense), at({0, 1, 0}));
  add(scene, scene::box({1, 0.5f, 1}), liquid(kWater), at({0, -0.5f, 0}));
  add(scene, scene::box({1, 0.4f, 1}), liquid(kDense), at({0, -1.4f, 0}));
  add_plate(scene, 3);
  const double expected = 10 * transmission_of({1, kDense, kWater, kDense, 1});
  for (const std::string& name : see_through_glass())
    expect_mean(with_integrator(looking_down(scene, 4), name), 128, expected);
}

// Three boxes that overlap along the view: the smallest has priority.
TEST(Refraction, OfBoxesThatOverlap) {
  scene::Scene scene;
  add(scene, scene::box({1, 1, 1}), liquid(kDense), at({0, 1, 0}));              // from 0 to 2
  add(scene, scene::box({1, 0.7f, 1}), liquid(kWater), at({0, -0.2f, 0}));       // from -0.9 to 0.5
  add(scene, scene::box({0.9f, 0.2f, 0.9f}), liquid(kGlass), at({0, 0.4f, 0}));  // from 0.2 to 0.6
  add_plate(scene, 3);
  const double expected = 10 * transmission_of({1, kDense, kGlass, kWater, 1});
  for (const std::string& name : see_through_glass())
    expect_mean(with_integrator(looking_down(scene, 4), name), 128, expected);
}

// Oblique refraction from water into a denser medium: Snell's law and Fresnel's equations use the ratio of the indices,
// and radiance is scaled by its square.
TEST(Refraction, FollowsSnellsLawOfTheRatio) {
  const double in = kWater, out = kDense;
  for (const double degrees : {20.0, 60.0, 80.0}) {
    const double angle = degrees * 3.14159265358979 / 180, sine = in / out * std::sin(angle);
    const double cos_in = std::cos(angle), cos_out = std::sqrt(1 - sine * sine);
    const double s = (in * cos_in - out * cos_out) / (in * cos_in + out * cos_out);
    const double p = (out * cos_in - in * cos_out) / (out * cos_in + in * cos_out);
    const double passed = 1 - (s * s + p * p) / 2;
    scene::Scene scene;
    add(scene, scene::box({20, 20, 20}), liquid(kWater));
    add(scene, scene::box({8, 1, 8}), liquid(kDense), at({0, -1, 0}));
    // A strip, half a metre below the boundary.
    add(scene, scene::box({0.002f, 0.001f, 1}), test::diffuse(Rgb(0), Rgb(10)),
        at({static_cast<float>(0.5 * sine / cos_out), -0.501f, 0}));
    const Vec3 down(static_cast<float>(std::sin(angle)), static_cast<float>(-std::cos(angle)), 0);
    const Document d = test::document(scene, look_at(-down, {0, 0, 0}, {0, 0, 1}, 1e-4f), 16, 16);
    const double expected = 10 * passed * in * in / (out * out);
    for (const char* name : {"path-pure", "path", "whitted", "bdpt"})
      expect_mean(with(with_integrator(d, name), "film.paths", "ESL"), 256, expected);
  }
}

// ---- Boundaries that must not change an image.

// Adds emitting boxes around the origin.
void add_surroundings(scene::Scene& scene) {
  for (int i = 0; i < 6; ++i) {
    const float phi = static_cast<float>(i), height = static_cast<float>(i % 3) - 1;
    add(scene, scene::cube(1, false), test::diffuse(Rgb(0), {1.0f + phi, 3, 7 - phi}),
        at({5 * std::cos(phi), 3 * height, 5 * std::sin(phi)}));
  }
  scene.environment.tint = {0.1f, 0.2f, 0.3f};
}

Document seen_from_above(scene::Scene scene) {
  return test::document(std::move(scene), look_at({0.3f, 1.5f, 4}, {0, 0, 0}, {0, 1, 0}, 0.6f), 32, 32);
}

// Compares images of Whitted's integrator, which follows every branch and needs no equal random numbers. One pixel in a
// hundred may differ by rounding at an edge.
void expect_same_image(const Document& a, const Document& b) {
  const auto film_a = test::rendered(without_cutoff(with_integrator(a, "whitted")), 4);
  const auto film_b = test::rendered(without_cutoff(with_integrator(b, "whitted")), 4);
  int different = 0;
  double sum = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      const Rgb p = film_a.mean(x, y), q = film_b.mean(x, y);
      sum += double{average(p)};
      for (int c = 0; c < 3; ++c)
        if (std::abs(p[c] - q[c]) > 1e-3f * std::max(1.0f, p[c])) {
          ++different;
          break;
        }
    }
  EXPECT_GT(sum, 0);
  EXPECT_LE(different, a.width * a.height / 100);
}

TEST(Invisible, ASolidInAnEqualMedium) {
  scene::Scene scene;
  add_surroundings(scene);
  add(scene, test::sphere(1, 16, false), liquid(kWater, {0.5f, 0.7f, 0.9f}));
  scene::Scene inside = scene;
  add(inside, test::sphere(0.5f, 8, false), liquid(kWater, {0.5f, 0.7f, 0.9f}), at({0.2f, 0.1f, 0}));
  const Document a = seen_from_above(scene);
  const Document b = seen_from_above(inside);
  expect_same_image(a, b);
  const auto means = [](const Document& d, uint64_t first_seed) {
    const auto mean = [&](uint64_t seed) {
      Document other = without_cutoff(with_integrator(d, "path-pure"));
      other.seed = seed;
      return test::Blocks{test::mean_of(test::rendered(other, 256)).value};
    };
    return test::replicated(mean, first_seed);
  };
  const test::Estimate of_a = means(a, 1000), of_b = means(b, 2000);
  test::expect_agreement(of_a, of_b, "path-pure");
  EXPECT_LT(std::sqrt(of_b.variance[0]), 0.02 * of_b.mean[0]);
}

// Water in a solid glass ball, water that ends inside the wall of a hollow one, and water that touches that wall.
TEST(Invisible, OverlappedBoundaries) {
  const auto filled = [](std::shared_ptr<const Mesh> wall) {
    scene::Scene scene;
    add_surroundings(scene);
    add(scene, std::move(wall), liquid(kGlass, {0.9f, 0.7f, 0.8f}));
    add(scene, test::sphere(0.7f, 16, false), liquid(kWater, {0.5f, 0.7f, 0.9f}));
    return seen_from_above(std::move(scene));
  };
  const Document nested = filled(test::sphere(1, 16, false));
  expect_same_image(nested, filled(test::shell(1, 0.6f, 16)));
  expect_same_image(nested, filled(test::shell(1, 0.7f, 16)));
  const auto mean = [](const Document& d) { return test::mean_of(test::rendered(with_integrator(d, "path"), 64)); };
  const test::Mean a = mean(nested), b = mean(filled(test::shell(1, 0.7f, 16)));
  EXPECT_NEAR(a.value, b.value, 4.5 * (a.standard_error + b.standard_error));
}

// Inside a solid of higher priority even rough and tinted boundaries have no effect, on shadow rays and on paths.
TEST(Invisible, ABoundaryInsideAHigherPriority) {
  const auto lit = [](bool crossed) {
    scene::Scene scene;
    add(scene, scene::box({1, 1, 1}), liquid(kWater, Rgb(0.6f)));
    add(scene, test::quad(0.8f), test::diffuse(Rgb(0.5f)), at({0, -0.8f, 0}));
    add(scene, test::quad(0.2f), test::diffuse(Rgb(0), Rgb(20)), at({0, 0.9f, 0}));
    Material wall = liquid(kGlass, Rgb(0.1f), 0.5f);
    wall.base_color = {0.5f, 1, 1};
    if (crossed) add(scene, scene::box({3, 0.1f, 3}), wall, at({0, 0.1f, 0}));
    return test::document(std::move(scene), look_at({0.2f, 0.5f, 0.9f}, {0, -0.8f, 0}, {0, 1, 0}, 0.6f), test::kSize,
                          test::kSize);
  };
  for (const char* name : {"path", "bdpt", "light", "mlt"}) {
    const char* paths = "ED(D|G)*L";
    test::expect_same_mean(with(with_integrator(lit(false), name), "film.paths", paths), 64,
                           with(with_integrator(lit(true), name), "film.paths", paths), 64, name, 4);
  }
}

// ---- Opacity: a ray that passes the boundary of a solid has entered it.

TEST(Opacity, RaysThatPassABoundaryAreInside) {
  scene::Scene scene;
  Material water = liquid(1, Rgb(0.5f));
  water.alpha_mode = AlphaMode::blend;
  water.alpha = 0.5f;
  add(scene, scene::box({2, 2, 2}), water, at({0, -2, 0}));
  add_plate(scene, 2);
  for (const char* name : {"path-pure", "path", "bdpt", "mlt"})
    expect_mean(with_integrator(looking_down(scene, 3), name), 64, 2.5);
}

TEST(Opacity, IntegratorsAgree) {
  Document d = test::light_in_tinted_water(true);
  scene::Scene scene = *d.scene;
  scene.materials[0].alpha_mode = AlphaMode::blend;
  scene.materials[0].alpha = 0.4f;
  add(scene, test::sphere(0.4f, 12, false), liquid(kGlass, {0.2f, 0.9f, 0.9f}), at({0.3f, 0.9f, -0.2f}));
  scene.materials.back().alpha_mode = AlphaMode::blend;
  scene.materials.back().alpha = 0.3f;
  d.scene = std::make_shared<const scene::Scene>(std::move(scene));
  const auto place = with(d, "film.paths", "E(D|G)+L");
  for (const char* name : {"bdpt", "light", "mlt", "distribution"})
    test::expect_same_mean(with_integrator(place, "path"), 96, with_integrator(place, name), 192, name, 4);
}

// ---- Other guarantees.

TEST(Media, SameImageWithAnyNumberOfThreads) {
  Document d = test::ice_in_water_in_glass(true);
  d.width = 70;
  d.height = 50;
  for (const auto& info : integrator::integrator_infos()) {
    if (info.name == "light-pure") continue;
    Document other = with_integrator(d, info.name);
    if (info.name == "mlt" || info.name == "pssmlt") other = with(other, "candidates", "256");
    const auto one = test::rendered(other, 2, 1);
    for (const int threads : {2, 7})
      test::expect_same_bits(one, test::rendered(other, 2, threads), info.name + " " + std::to_string(threads));
  }
}

TEST(Media, ResumedRenderingIsBitIdentical) {
  Document d = test::ice_in_water_in_glass(false);
  d.width = 70;
  d.height = 50;
  for (const char* name : {"mlt", "bdpt", "sppm"}) {
    Document other = with_integrator(d, name);
    if (std::string(name) == "mlt") other = with(other, "candidates", "64");
    test::expect_same_bits_after_resume(other, name, std::string(name) == "mlt");
  }
}

TEST(Media, PathClassesAddUp) {
  for (const Document& place : {test::bubble(), test::ice_in_water_in_glass(true)})
    for (const char* name : {"path", "distribution"}) {
      const Document d = with_integrator(place, name);
      const auto whole = test::rendered(d, 16);
      test::expect_same_bits(whole, test::rendered(with(d, "model.classes", "on"), 16), name);
      std::vector<film::Film> parts;
      for (const char* paths : {"EL", "E(D|G)L", "E(D|G).+L", "ES.*L"})
        parts.push_back(test::rendered(with(d, "film.paths", paths), 16));
      for (int y = 0; y < d.height; ++y)
        for (int x = 0; x < d.width; ++x) {
          Rgb sum(0);
          for (const auto& part : parts) sum += part.mean(x, y);
          for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c], whole.mean(x, y)[c], 1e-4f * (1 + sum[c])) << name;
        }
    }
}

TEST(Media, LargerModelsGiveTheSameImage) {
  for (const char* name : {"path", "whitted", "bdpt", "mlt"}) {
    const Document d = with_integrator(test::bubble(), name);
    test::expect_same_bits(test::rendered(d, 8), test::rendered(with(d, "model.surfaces", "on"), 8), name);
  }
}

// Solids that move across a light and the camera while the shutter is open.
TEST(Media, MovingSolids) {
  scene::Scene scene;
  add(scene, test::quad(4), test::diffuse(Rgb(0.6f)), at({0, -0.6f, 0}));
  const int outer = add(scene, test::sphere(0.8f, 12, false), liquid(kWater, {0.4f, 0.7f, 0.9f}));
  const int inner = add(scene, test::sphere(0.3f, 12, false), liquid(kGlass, {0.9f, 0.5f, 0.3f}, 0.3f));
  add(scene, test::sphere(0.15f, 8, false), test::diffuse(Rgb(0.2f), Rgb(9)), at({0.7f, 0.2f, 0}));
  scene.environment.tint = {0.7f, 0.8f, 1.0f};
  for (const int i : {outer, inner}) {
    scene.nodes[static_cast<size_t>(i)].transform = {};
    test::animate(scene, i, scene::AnimatedPath::translation, {0, 1}, {-0.5f, 0, 0, 0.5f, 0, 0});
  }
  Camera camera = look_at({-1.1f, 0.3f, 0.3f}, {0.3f, 0, 0}, {0, 1, 0}, 1);
  camera.shutter = 1;
  Document d = test::document(std::move(scene), camera, test::kSize, test::kSize);
  const auto c = scene::compile(d.scene, d.camera, nullptr);
  ASSERT_EQ(c->solids().size(), 2U);
  ASSERT_TRUE(c->solids()[0].is_moving);
  for (const char* name : {"path-pure", "bdpt", "mlt"})
    test::expect_same_mean(with_integrator(d, "path"), 128, with_integrator(d, name), 256, name, 3);
}

TEST(Media, DecisionsStateTheirReason) {
  const auto reason = [](const scene::Scene& scene) {
    const auto d = looking_down(scene, 3);
    const auto model = transport::model_for(*scene::compile(d.scene, d.camera, nullptr));
    for (const auto& decision : model.decisions)
      if (decision.flag == "media") return decision.value + ": " + decision.reason;
    return std::string();
  };
  scene::Scene scene;
  const int ball = add(scene, test::sphere(1, 8, false), liquid(kGlass));
  scene.nodes[static_cast<size_t>(ball)].name = "ball";
  EXPECT_EQ(reason(scene), "vacuum: no solid absorbs or touches another one");
  scene::Scene nested = scene;
  add(nested, test::sphere(2, 8, false), liquid(kWater));
  EXPECT_EQ(reason(nested), "solids: the bounds of node 'ball' intersect those of another solid");
  scene::Scene tinted = scene;
  add(tinted, test::sphere(1, 8, false), liquid(kWater, Rgb(0.5f)), at({0, 0, 9}));
  tinted.materials.back().name = "water";
  EXPECT_EQ(reason(tinted), "solids: material 'water' absorbs inside");
}

}  // namespace
}  // namespace etendue::media_test
