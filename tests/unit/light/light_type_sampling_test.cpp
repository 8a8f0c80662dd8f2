// Every registered light type, with several parameters: samples from receivers, ray casting, and emitted rays agree.
//
// Comparisons are z-tests at 5 standard errors, with a false-alarm rate of 6e-7 each and 3e-4 over the fewer than 500
// comparisons of this file. Seeds are fixed.
#include <gtest/gtest.h>

#include "scene/builtin/shapes.h"
#include "scene/compiled_scene.h"
#include "unit/light/light_queries.h"

namespace etendue::light_type_sampling_test {
namespace {

using test::RandomNumbers;
using test::Receivers;

constexpr double kPiD = 3.14159265358979;

// A mean with its standard error.
struct Estimate {
  double sum = 0, squares = 0;
  int count = 0;

  void add(double x) {
    sum += x;
    squares += x * x;
    ++count;
  }
  double mean() const { return sum / count; }
  double variance() const { return std::max(0.0, squares / count - sqr(mean())) / count; }
};

void expect_near(const Estimate& e, double expected, const std::string& what) {
  EXPECT_NEAR(e.mean(), expected, 5 * std::sqrt(e.variance()) + 1e-5 * std::abs(expected)) << what;
}
void expect_near(const Estimate& a, const Estimate& b, const std::string& what) {
  EXPECT_NEAR(a.mean(), b.mean(), 5 * std::sqrt(a.variance() + b.variance()) + 2e-5 * std::abs(a.mean()) + 1e-12)
      << what;
}

// Each type with its defaults, and with one parameter changed.
std::vector<Light> lights() {
  const std::pair<const char*, Value> kChanges[] = {{"focus", 2.5},
                                                    {"two-sided", true},
                                                    {"quantity", std::string("power")},
                                                    {"points", int64_t{5}},
                                                    {"inner-cone", 0.7},
                                                    {"range", 2.0},
                                                    {"profile", std::string("smoothstep")},
                                                    {"length", 4.0},
                                                    {"radius", 0.8},
                                                    {"image", std::string("bars")}};
  std::vector<Light> list;
  for (const LightTypeInfo& info : light_type_infos()) {
    Light light = make_light(info.description.name, {{"intensity", 3.0}});
    light.name = info.description.name;
    list.push_back(light);
    for (const auto& [parameter, value] : kChanges) {
      Light changed = light;
      if (!find_parameter(info.parameters, parameter)) continue;
      if (!checked_value(*find_parameter(info.parameters, parameter), value)) continue;
      changed.set(parameter, value);
      changed.name += std::string(" with ") + parameter;
      list.push_back(changed);
    }
  }
  return list;
}

LightClass class_of(const Light& light) { return light.info().description.light_class; }
bool has_points(const Light& light) {
  const auto points = light.parameter("points");
  return points && std::get<int64_t>(*points) > 0;
}

// Above the origin and facing it.
const Vec3 kPosition(0.3f, -0.2f, 1.4f);

struct LitScene {
  std::shared_ptr<const scene::CompiledScene> compiled;

  explicit LitScene(const Light& light) {
    scene::Scene description;
    scene::Transform place;
    place.matrix = look_at(kPosition, Vec3(0), {0, 1, 0}, 1).to_world;
    scene::add(description, light, place);
    // Gives the scene a bounding sphere that contains the light and the receivers; below everything else.
    Mat4 below(1);
    below[3] = Vec4(0, -4, 0, 1);
    scene::add(description, scene::quad(6), scene::diffuse(Rgb(0)), below);
    compiled = scene::compile(std::make_shared<const scene::Scene>(std::move(description)), Camera(), nullptr);
  }
  const LightTable& table() const { return compiled->lights(); }

  // Incident radiance at the origin from a direction.
  double radiance(const Vec3& direction) const {
    Ray ray;
    ray.origin = Vec3(0);
    ray.direction = direction;
    const Hit hit = compiled->intersect(ray, 0);
    if (!hit) return 0;
    scene::SurfacePoint point;
    const Vec3 wo = -direction;
    compiled->surfaces({&wo, 1}, {&hit, 1}, &point);
    return static_cast<double>(compiled->emitted(point, wo).g);
  }

  // Position and direction of an emitted ray, and its flux in W.
  struct EmittedRay {
    Vec3 position, direction;
    double flux;
  };
  EmittedRay trace(Emission e) const {
    if (!(e.weight > 0)) return {Vec3(0), Vec3(0, 0, 1), 0};
    auto flux = static_cast<double>(e.radiance.g * e.weight);
    if (e.kind == LightKind::triangle) {
      Hit hit;
      Vec3 side;
      compiled->locate(e, hit, side);
      scene::SurfacePoint point;
      compiled->surfaces({&side, 1}, {&hit, 1}, &point);
      e.position = point.position;
      flux *= static_cast<double>(table().triangles()[e.light].profile(e.direction.z));
      e.direction = Frame(side).to_world(e.direction);
    }
    return {e.position, e.direction, flux};
  }
};

// Calls use(direction, density) for samples at the origin.
template <class Use>
void for_samples(const LitScene& lit, LightStrategy strategy, int rounds, Use&& use) {
  RandomNumbers random(3);
  Receivers receivers;
  for (int round = 0; round < rounds; ++round) {
    receivers.draw(random, Vec3(0));
    for (const LightSample& s : receivers.sample(lit.table(), strategy)) use(s);
  }
}

// Integrals of radiance times functions of the direction, by sampling the light and by uniform sampling of the sphere.
TEST(LightTypeSampling, AgreesWithRayCasting) {
  using Function = double (*)(const Vec3&);
  const Function kFunctions[] = {[](const Vec3&) { return 1.0; },
                                 [](const Vec3& w) { return static_cast<double>(w.z); },
                                 [](const Vec3& w) { return static_cast<double>(w.x * w.x); },
                                 [](const Vec3& w) { return static_cast<double>(w.x * w.y + 1); }};
  for (const Light& light : lights()) {
    if (class_of(light) != LightClass::area || has_points(light)) continue;
    const LitScene lit(light);
    Estimate cast[4];
    RandomNumbers random(4);
    for (int i = 0; i < 200'000; ++i) {
      const Vec3 w = random.direction();
      const double radiance = lit.radiance(w);
      for (size_t k = 0; k < 4; ++k) cast[k].add(4 * kPiD * radiance * kFunctions[k](w));
    }
    for (const LightStrategy strategy : {LightStrategy::one, LightStrategy::tree, LightStrategy::emission_pdf}) {
      Estimate sampled[4];
      for_samples(lit, strategy, 60, [&](const LightSample& s) {
        const double value = s.pdf > 0 ? static_cast<double>(s.radiance.g / s.pdf) : 0;
        for (size_t k = 0; k < 4; ++k) sampled[k].add(value * (value > 0 ? kFunctions[k](s.wi) : 0));
      });
      for (size_t k = 0; k < 4; ++k)
        expect_near(sampled[k], cast[k],
                    light.name + ", strategy " + std::to_string(static_cast<int>(strategy)) + ", function " +
                        std::to_string(k));
    }
  }
}

// The density of a sample is the one that `pdf_triangle` states for its point.
TEST(LightTypeSampling, HasTheStatedDensity) {
  for (const Light& light : lights()) {
    if (class_of(light) != LightClass::area || has_points(light)) continue;
    const LitScene lit(light);
    for (const LightStrategy strategy : {LightStrategy::one, LightStrategy::tree, LightStrategy::emission_pdf}) {
      int sampled = 0;
      for_samples(lit, strategy, 1, [&](const LightSample& s) {
        if (s.pdf == 0) return;
        ++sampled;
        const float pdf = lit.table().pdf_triangle(s.light, Vec3(0), s.wi * s.distance, 0, strategy);
        EXPECT_NEAR(pdf / s.pdf, 1, 2e-3f) << light.name;
      });
      EXPECT_GT(sampled, 100) << light.name;
    }
  }
}

// The direction and the distance of every sample of a delta light are known.
TEST(LightTypeSampling, DeltaLightsAreExact) {
  for (const Light& light : lights()) {
    const LitScene lit(light);
    for_samples(lit, LightStrategy::one, 1, [&](const LightSample& s) {
      if (class_of(light) == LightClass::delta_position) {
        EXPECT_EQ(s.pdf, 1) << light.name;
        EXPECT_LT(glm::distance(s.wi * s.distance, kPosition), 1e-5f) << light.name;
      } else if (class_of(light) == LightClass::delta_direction) {
        EXPECT_EQ(s.pdf, 1) << light.name;
        EXPECT_LT(glm::distance(s.wi, glm::normalize(kPosition)), 1e-5f) << light.name;
        EXPECT_EQ(s.distance, kInfinity);
      } else if (class_of(light) == LightClass::ambient) {
        EXPECT_EQ(s.pdf, 1 / (4 * kPi));
        EXPECT_EQ(s.distance, 0) << "nothing blocks it";
      }
    });
  }
}

// Ambient light of radiance L: E = pi L.
TEST(LightTypeSampling, AmbientIrradiance) {
  for (const Light& light : lights()) {
    if (class_of(light) != LightClass::ambient) continue;
    Estimate irradiance;
    for_samples(LitScene(light), LightStrategy::one, 40, [&](const LightSample& s) {
      irradiance.add(static_cast<double>(s.radiance.g * std::max(s.wi.z, 0.0f) / s.pdf));
    });
    expect_near(irradiance, 3 * kPiD, light.name);
  }
}

// The mean flux of emitted rays is the flux of the light.
TEST(LightTypeEmission, HasTheFluxOfTheLight) {
  for (const Light& light : lights()) {
    const LitScene lit(light);
    Estimate flux;
    RandomNumbers random(5);
    for (int i = 0; i < 100'000; ++i) {
      const float choice = random();
      const Vec2 point = random.pair();
      flux.add(lit.trace(lit.table().sample_emission({choice, point, random.pair()})).flux);
    }
    const auto expected = static_cast<double>(light.flux().g);
    if (expected > 0) expect_near(flux, expected, light.name);
    if (class_of(light) == LightClass::ambient) {
      EXPECT_EQ(flux.sum, 0) << "it emits no ray";
    }
  }
}

// The flux through a disk around the origin, by light samples from points of the disk and by emitted rays that cross
// it.
TEST(LightTypeEmission, AgreesWithSamplingFromReceivers) {
  constexpr float kRadius = 0.6f;
  for (const Light& light : lights()) {
    if (class_of(light) == LightClass::ambient) continue;
    const LitScene lit(light);
    RandomNumbers random(6);
    Estimate received;
    Receivers receivers;
    for (int round = 0; round < 100; ++round) {
      receivers.draw(random, Vec3(0));
      for (size_t i = 0; i < Receivers::kCapacity; ++i)
        receivers.from.set(i, Vec3(kRadius * square_to_disk(random.pair()), 0));
      for (const LightSample& s : receivers.sample(lit.table())) {
        const double irradiance = s.pdf > 0 ? static_cast<double>(s.radiance.g * std::max(s.wi.z, 0.0f) / s.pdf) : 0.0;
        received.add(kPiD * static_cast<double>(sqr(kRadius)) * irradiance);
      }
    }
    Estimate arrived;
    for (int i = 0; i < 400'000; ++i) {
      const float choice = random();
      const Vec2 point = random.pair();
      const Emission e = lit.table().sample_emission({choice, point, random.pair()});
      const auto ray = lit.trace(e);
      const float distance = -ray.position.z / ray.direction.z;
      const Vec3 hit = ray.position + distance * ray.direction;
      const bool crosses = ray.flux > 0 && ray.direction.z < 0 && distance > 0 && glm::length(hit) < kRadius;
      arrived.add(crosses ? ray.flux * static_cast<double>(lit.table().range_window(e.light, distance)) : 0);
    }
    EXPECT_GT(received.mean(), 0) << light.name;
    expect_near(arrived, received, light.name);
  }
}

// The densities of an emitted ray equal those stated for rays that another technique samples.
TEST(LightTypeEmission, HasTheStatedDensities) {
  for (const Light& light : lights()) {
    const LitScene lit(light);
    RandomNumbers random(7);
    for (int i = 0; i < 1000; ++i) {
      const float choice = random();
      const Vec2 point = random.pair();
      const Emission e = lit.table().sample_emission({choice, point, random.pair()});
      if (!(e.weight > 0)) continue;
      EmissionDensity stated;
      if (e.kind == LightKind::triangle) {
        stated = lit.table().emission_density(e.light, e.direction.z);
      } else {
        LightSample sample;
        sample.kind = e.kind;
        sample.light = e.light;
        stated = lit.table().emission_density(sample);
      }
      EXPECT_EQ(stated.first, e.density.first) << light.name;
      EXPECT_EQ(stated.second, e.density.second) << light.name;
      EXPECT_EQ(stated.delta, e.density.delta) << light.name;
      EXPECT_EQ(stated.infinite, e.density.infinite) << light.name;
    }
  }
}

// A resampled ray keeps its first end and the density of that end.
TEST(LightTypeEmission, ResamplesTheSecondEnd) {
  for (const Light& light : lights()) {
    const LitScene lit(light);
    RandomNumbers random(8);
    for (int i = 0; i < 200; ++i) {
      const float choice = random();
      const Vec2 point = random.pair();
      const Emission e = lit.table().sample_emission({choice, point, random.pair()});
      if (!(e.weight > 0)) continue;
      Emission resampled = e;
      lit.table().resample_emission(random.pair(), resampled);
      EXPECT_EQ(resampled.density.first, e.density.first) << light.name;
      if (e.density.infinite)
        EXPECT_EQ(resampled.direction, e.direction) << light.name;
      else
        EXPECT_EQ(resampled.position, e.position) << light.name;
      EXPECT_FALSE(resampled.position == e.position && resampled.direction == e.direction) << light.name;
    }
  }
}

}  // namespace
}  // namespace etendue::light_type_sampling_test
