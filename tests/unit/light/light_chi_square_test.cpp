// Chi-square tests of sampled directions against the stated densities: photometric profiles, projectors, cylinders, the
// sky with its sun, and environment portals. The false-alarm rate of the file is 1 %.
#include <gtest/gtest.h>

#include "equations/pearson_test.h"
#include "light/environments/hosek_sky.h"
#include "light/photometry_reader.h"
#include "light/sampling/environment_portals.h"
#include "scene/builtin/shapes.h"
#include "scene/compiled_scene.h"
#include "support/chi_square.h"
#include "unit/light/light_queries.h"

namespace etendue::light_chi_square_test {
namespace {

using test::RandomNumbers;

constexpr int kTests = 14;
constexpr int kSamples = 40'000;

void expect_density(const std::function<bool(Vec3&)>& sample, const std::function<double(const Vec3&)>& pdf,
                    const std::string& what) {
  const auto result = test::chi_square_on_sphere(sample, pdf, kSamples);
  EXPECT_GT(result.p_value, 1 - std::pow(0.99, 1.0 / kTests))
      << what << " chi2 " << result.statistic << " dof " << result.degrees;
}

// A profile that is not dark anywhere between its angles.
PhotometryProfile bright_profile(const std::string& angles, int type) {
  const auto profile = parse_photometry("TILT=NONE\n1 1000 1 3 3 " + std::to_string(type) + " 2 0 0 0\n1 1 50\n" +
                                            angles + "\n10 20 30\n40 50 60\n70 80 90\n",
                                        "light.ies");
  EXPECT_TRUE(profile) << (profile ? "" : profile.error().message);
  return *profile;
}

TEST(LightDensity, DirectionsOfPhotometricProfiles) {
  const std::pair<const char*, int> kProfiles[] = {
      {"0 45 90\n0 180 360", 1}, {"20 50 75\n0 45 90", 1}, {"-60 0 80\n-50 0 70", 2}, {"-40 10 50\n0 30 60", 3}};
  for (const auto& [angles, type] : kProfiles) {
    const PhotometryProfile profile = bright_profile(angles, type);
    RandomNumbers random(static_cast<uint32_t>(type));
    expect_density(
        [&](Vec3& w) {
          w = profile.sample_direction(random.pair());
          return true;
        },
        [&](const Vec3& w) { return profile.intensity(w) > 0 ? static_cast<double>(profile.direction_pdf()) : 0.0; },
        "type " + std::to_string(type) + " " + angles);
  }
}

std::shared_ptr<const scene::CompiledScene> scene_with(const Light& light, const Vec3& position, const Vec3& target) {
  scene::Scene description;
  scene::Transform place;
  place.matrix = look_at(position, target, {0, 1, 0}, 1).to_world;
  scene::add(description, light, place);
  return scene::compile(std::make_shared<const scene::Scene>(std::move(description)), Camera(), nullptr);
}

// Directions of emitted rays: uniform over the cone around the image, which is as high as it is wide.
TEST(LightDensity, DirectionsOfProjectors) {
  for (const double field : {0.5, 1.4}) {
    const Light light = make_light("projector", {{"field", field}, {"image", std::string("checkerboard")}});
    const auto scene = scene_with(light, Vec3(0), Vec3(0, 0, -1));
    const double cos_outer = 1 / std::sqrt(1 + 2 * sqr(std::tan(0.5 * field)));
    LightSample sample;
    sample.kind = LightKind::placed;
    const auto density = static_cast<double>(scene->lights().emission_density(sample).second);
    RandomNumbers random(11);
    expect_density(
        [&](Vec3& w) {
          const float choice = random();
          const Vec2 point = random.pair();
          w = scene->lights().sample_emission({choice, point, random.pair()}).direction;
          return true;
        },
        [&](const Vec3& w) { return -static_cast<double>(w.z) > cos_outer ? density : 0.0; },
        "field " + std::to_string(field));
  }
}

// Directions from a receiver to a cylinder, from the side, close to its end, and inside the prolonged tube.
TEST(LightDensity, DirectionsToCylinders) {
  for (const Vec3& from : {Vec3(0, 0, 1.5f), Vec3(1.1f, 0.2f, 0.5f), Vec3(2, 0.02f, 0.01f)}) {
    const Light light = make_light("cylinder", {{"length", 2.0}, {"radius", 0.3}});
    const auto scene = scene_with(light, Vec3(0), Vec3(0, 0, -1));
    RandomNumbers random(12);
    test::Receivers receivers;
    std::vector<LightSample> samples;
    size_t next = 0;
    expect_density(
        [&](Vec3& w) {
          if (next == samples.size()) {
            receivers.draw(random, from);
            const auto drawn = receivers.sample(scene->lights(), LightStrategy::one);
            samples.assign(drawn.begin(), drawn.end());
            next = 0;
          }
          const LightSample& s = samples[next++];
          w = s.wi;
          return s.pdf > 0;
        },
        [&](const Vec3& w) {
          Ray ray;
          ray.origin = from;
          ray.direction = w;
          const Hit hit = scene->intersect(ray, 0);
          if (!hit) return 0.0;
          return static_cast<double>(scene->lights().pdf_triangle(0, from, from + w * hit.t, 0, LightStrategy::one));
        },
        "from x " + std::to_string(from.x));
  }
}

// Maps of both models, with and without the sun. Its disk is smaller than a cell of the test.
TEST(LightDensity, DirectionsToTheSky) {
  for (const SkyModel model : {SkyModel::preetham, SkyModel::hosek_wilkie}) {
    Sky sky;
    sky.model = model;
    sky.sun_disk = false;
    const EnvironmentMap map(make_sky(sky));
    RandomNumbers random(13);
    expect_density(
        [&](Vec3& w) {
          const auto s = map.sample(random.pair());
          w = s.direction;
          return s.pdf_solid_angle > 0;
        },
        [&](const Vec3& w) { return static_cast<double>(map.pdf_solid_angle(w)); },
        "sky model " + std::to_string(static_cast<int>(model)));
  }
}

// The disk alone, in a frame that magnifies it: 32 rings of equal solid angle by 8 sectors.
TEST(LightDensity, DirectionsToTheSun) {
  const Environment environment = make_sky({});
  const SunCone sun(*environment.sun, environment.sun->direction);
  const Frame frame(environment.sun->direction);
  RandomNumbers random(14);
  std::vector<int> counts(256);
  const double chord2 = 4 * sqr(std::sin(0.5 * double{environment.sun->angular_radius}));
  for (int i = 0; i < kSamples; ++i) {
    const Vec3 w = sun.sample(random.pair());
    ASSERT_NEAR(sun.pdf(w) * sun.solid_angle(), 1, 1e-5);
    const Vec3 local = frame.to_local(w - environment.sun->direction);
    const double ring = std::min(static_cast<double>(length_squared(local)) / chord2 * 32, 31.9);
    const double sector = (std::atan2(double{local.y}, double{local.x}) / (2 * M_PI) + 0.5) * 8;
    ++counts[static_cast<size_t>(ring) * 8 + static_cast<size_t>(std::min(sector, 7.9))];
  }
  double statistic = 0;
  for (const int count : counts) statistic += sqr(count - kSamples / 256.0) / (kSamples / 256.0);
  EXPECT_GT(equations::chi_square_survival(statistic, 255), 1 - std::pow(0.99, 1.0 / kTests));
}

// Directions through two portals, from receivers that face one or both.
TEST(LightDensity, DirectionsThroughPortals) {
  const EnvironmentPortals portals(
      {{.centre = {0, 0, 2}, .half_x = {0.5f, 0, 0}, .half_y = {0, 0.25f, 0}, .normal = {0, 0, -1}},
       {.centre = {2, 0, 0}, .half_x = {0, 0, 0.3f}, .half_y = {0, 0.3f, 0}, .normal = {-1, 0, 0}}});
  for (const Vec3& from : {Vec3(0), Vec3(3, 0.1f, 0.4f)}) {
    RandomNumbers random(15);
    expect_density(
        [&](Vec3& w) {
          w = portals.sample(from, random.pair());
          return true;
        },
        [&](const Vec3& w) { return static_cast<double>(portals.pdf(from, w)); }, "from x " + std::to_string(from.x));
  }
}

}  // namespace
}  // namespace etendue::light_chi_square_test
