// Heterogeneous and emitting media in integrators: closed forms, furnaces, special cases, agreement, refusals.
//
// Means are compared within 4.5 standard errors, which are bounded: one false alarm in 150,000 comparisons of normal
// means.
#include <gtest/gtest.h>

#include <cmath>

#include "integrator/integrator.h"
#include "render/incompatibility.h"
#include "statistical/media/class_sums.h"
#include "statistical/media/expected_radiance.h"
#include "support/integrator_scenes.h"
#include "support/scattering_scenes.h"
#include "support/translation.h"
#include "transport/model.h"

namespace etendue::heterogeneous {
namespace {

using render::Document;
using test::at;
using test::expect_radiance;
using test::medium;
using test::medium_boundary;
using test::with;
using test::with_integrator;

constexpr const char* kIntegrators[] = {"path", "path-pure"};

MediumDescription with_density(MediumDescription m, const char* name, const std::vector<Setting>& settings = {}) {
  m.density.field = *make_density(name, settings);
  return m;
}

MediumDescription emitting(MediumDescription m, const Rgb& emission) {
  m.emission = emission;
  return m;
}

// A camera whose pixels all see in one direction.
Document narrow(scene::Scene scene, const Vec3& eye, const Vec3& target) {
  const Vec3 along = glm::normalize(target - eye);
  const Vec3 up = std::abs(along.y) > 0.9f ? Vec3(0, 0, 1) : Vec3(0, 1, 0);
  return test::document(std::move(scene), look_at(eye, target, up, 1e-4f), 16, 16);
}

// A box of 2 m around the origin, above a plate that emits radiance 10.
scene::Scene plate_below(const MediumDescription& m) {
  scene::Scene scene;
  add(scene, scene::box({2, 1, 2}), medium_boundary(m));
  add(scene, test::quad(1.5f), test::diffuse(Rgb(0), Rgb(10)), at({0, -1.5f, 0}));
  return scene;
}

Document from_above(scene::Scene scene) { return narrow(std::move(scene), {0.01f, 3, 0.02f}, {0.01f, 0, 0.02f}); }

TEST(Heterogeneous, AbsorptionFollowsBeersLaw) {
  const Rgb absorption(0.2f, 0.5f, 1);
  struct Slab {
    const char* name;
    double depth;  // integral of the density over 2 m
  };
  for (const Slab& s : {Slab{"linear", 1}, Slab{"exponential", 2 * 0.2 * (1 - std::exp(-5))}}) {
    const Document d = from_above(plate_below(with_density(medium(Rgb(0), absorption), s.name)));
    Rgb expected;
    for (int c = 0; c < 3; ++c)
      expected[c] = static_cast<float>(10 * std::exp(-static_cast<double>(absorption[c]) * s.depth));
    for (const char* name : kIntegrators) expect_radiance(with_integrator(d, name), 256, expected, 0.01, s.name);
  }
}

// An absorbing and emitting slab in front of a plate: L = 10 T + L_e (1 - T).
TEST(Heterogeneous, EmittingSlab) {
  const Rgb absorption(0.2f, 0.5f, 1), emission(3, 2, 1);
  const MediumDescription m = emitting(medium(Rgb(0), absorption), emission);
  Rgb expected;
  for (int c = 0; c < 3; ++c) {
    const float t = std::exp(-absorption[c]);
    expected[c] = 10 * t + emission[c] * (1 - t);
  }
  MediumDescription half = m;
  half.absorption *= 0.5f;
  for (const char* name : kIntegrators) {
    expect_radiance(with_integrator(from_above(plate_below(half)), name), 4, expected, 1e-5, "homogeneous");
    expect_radiance(with_integrator(from_above(plate_below(with_density(m, "linear"))), name), 256, expected, 0.01,
                    "linear");
  }
}

// Emission is light: it takes part in path classes and scattering. The medium has albedo 1/2 and one temperature, so a
// closed isothermal cavity of it has its radiance everywhere.
TEST(Heterogeneous, IsothermalMediumInASkyOfItsRadiance) {
  for (const char* density : {"", "ball", "cloud"}) {
    MediumDescription m = emitting(medium({2, 1, 0.5f}, {2, 1, 0.5f}, 0.4f), Rgb(3));
    if (*density) m = with_density(m, density);
    scene::Scene scene;
    add(scene, scene::box(Vec3(1)), medium_boundary(m));
    scene.environment.tint = Rgb(3);
    for (const char* name : kIntegrators)
      expect_radiance(with_integrator(narrow(scene, {0.1f, 0.2f, 3}, {0.1f, 0.1f, 0}), name), 128, Rgb(3), 0.01,
                      std::string(name) + ' ' + density);
  }
}

TEST(Heterogeneous, WhiteFurnace) {
  for (const char* density : {"exponential", "ball", "cloud"}) {
    const MediumDescription m = with_density(medium({6, 1, 0.3f}, Rgb(0), 0.7f), density);
    scene::Scene scene;
    add(scene, scene::box(Vec3(1)), medium_boundary(m));
    add(scene, test::sphere(0.5f, 16, false), test::turbid_liquid(1.5f, m), at({2, 0, 0}));
    scene.environment.tint = Rgb(1);
    const std::pair<const char*, Document> views[] = {
        {"from outside", narrow(scene, {0.1f, 0.2f, 3}, {0.1f, 0.1f, 0})},
        {"from inside", narrow(scene, {0.1f, 0.2f, 0.1f}, {0.1f, 0.1f, -1})},
        {"in glass", narrow(scene, {2.1f, 0.2f, 3}, {2.1f, 0.1f, 0})}};
    for (const auto& [view, d] : views)
      for (const char* name : kIntegrators)
        expect_radiance(with_integrator(d, name), 32, Rgb(1), 0.02, std::string(density) + ' ' + view + ' ' + name);
  }
}

TEST(Heterogeneous, AtmosphereInAWhiteFurnace) {
  scene::Scene scene;
  add(scene, test::sphere(0.5f, 16, false), test::diffuse(Rgb(1)));
  scene.atmosphere.medium = with_density(medium({0.8f, 0.4f, 1.2f}, Rgb(0), 0.5f), "exponential", {{"base", 0.3}});
  scene.atmosphere.radius = 2;
  scene.environment.tint = Rgb(1);
  for (const float distance : {5.0f, 1.0f})
    for (const char* name : kIntegrators)
      expect_radiance(with_integrator(narrow(scene, {0.1f, 0.2f, distance}, {0.1f, 0.2f, 0}), name), 64, Rgb(1), 0.02,
                      name);
}

Document scene_with(const MediumDescription& m) {
  scene::Scene scene = test::balls();
  add(scene, scene::box({1.5f, 1, 1.5f}), medium_boundary(m), at({0, 1.1f, 0}));
  scene.environment.tint = {0.5f, 0.7f, 1};
  return test::view_from_above(std::move(scene));
}

// A constant grid has the paths of the homogeneous medium. With exact transmittance, so are the images.
TEST(SpecialCases, AConstantGridEqualsTheHomogeneousMedium) {
  const MediumDescription homogeneous = emitting(medium({0.6f, 0.3f, 0.1f}, {0, 0.1f, 0.3f}, 0.4f), Rgb(0));
  MediumDescription constant = with_density(homogeneous, "constant");
  constant.estimator = TransmittanceEstimator::regular;
  for (const char* name : kIntegrators) {
    const film::Film a = test::rendered(with_integrator(scene_with(homogeneous), name), 4),
                     b = test::rendered(with_integrator(scene_with(constant), name), 4);
    int different = 0;
    for (int y = 0; y < a.height(); ++y)
      for (int x = 0; x < a.width(); ++x)
        for (int c = 0; c < 3; ++c)
          if (std::abs(a.mean(x, y)[c] - b.mean(x, y)[c]) > 1e-3f * a.mean(x, y)[c] + 1e-5f) ++different;
    // Rounding sends a few paths elsewhere.
    EXPECT_LE(different, a.width() * a.height() / 50) << name;
    for (const char* estimator : {"delta", "ratio", "residual-ratio"}) {
      MediumDescription other = constant;
      for (size_t i = 0; i < Options<TransmittanceEstimator>::kOptions.size(); ++i)
        if (std::string(Options<TransmittanceEstimator>::kOptions[i].name) == estimator)
          other.estimator = static_cast<TransmittanceEstimator>(i);
      test::expect_agreement(test::replicated(with_integrator(scene_with(homogeneous), name), 16, 1000),
                             test::replicated(with_integrator(scene_with(other), name), 16, 2000), estimator, 6);
    }
  }
}

TEST(SpecialCases, EmissionOfZeroEqualsNone) {
  const MediumDescription none = with_density(medium({2, 1, 0.5f}, {0, 0.1f, 0.3f}), "ball");
  MediumDescription zero = none;
  zero.temperature = 3000;
  for (const char* name : kIntegrators)
    EXPECT_TRUE(test::same_bits(test::rendered(with_integrator(scene_with(none), name), 4),
                                test::rendered(with_integrator(scene_with(zero), name), 4)));
}

std::vector<std::pair<const char*, Document>> places() {
  MediumDescription flame = with_density(emitting(medium(Rgb(0.5f), Rgb(3)), Rgb(4)), "flame");
  flame.temperature = 2500;
  return {{"cloud", scene_with(with_density(medium(Rgb(6), Rgb(0.1f), 0.5f), "cloud"))},
          {"chromatic", scene_with(with_density(medium({6, 2, 0.2f}, {0, 1, 2}, 0.3f), "linear"))},
          {"flame", scene_with(flame)}};
}

TEST(Agreement, OfIntegratorsWithHeterogeneousMedia) {
  for (const auto& [name, d] : places())
    test::expect_agreement(test::replicated(with_integrator(d, "path"), 48, 1000),
                           test::replicated(with_integrator(d, "path-pure"), 96, 2000), name, 3);
}

TEST(PathClassesOfHeterogeneousMedia, SumToTheImage) {
  for (const auto& [name, d] : places()) {
    test::expect_sum_of_classes(d, {"EL", "E(D|G|S)+L", "E(D|G|S)*V(D|G|S)*L", "E(D|G|S)*V.*V.*L"}, 4, name);
  }
}

TEST(Threads, DoNotChangeImagesOfHeterogeneousMedia) {
  for (const auto& [name, place] : places()) {
    const film::Film one = test::rendered(place, 4, 1);
    EXPECT_TRUE(test::same_bits(one, test::rendered(place, 4, 2))) << name;
    EXPECT_TRUE(test::same_bits(one, test::rendered(place, 4, 7))) << name;
  }
}

TEST(ExtremeHeterogeneousMedia, AreFinite) {
  const MediumDescription media[] = {
      with_density(medium(Rgb(50), Rgb(50)), "cloud"), with_density(medium({1e6f, 1, 0}, {0, 0, 1e6f}), "ball"),
      with_density(medium({1e-30f, 0, 0}), "linear"), with_density(medium(Rgb(1)), "constant", {{"value", 0.0}}),
      with_density(emitting(medium(Rgb(0), Rgb(100)), Rgb(1e5f)), "ball")};
  for (const MediumDescription& m : media)
    for (const char* name : kIntegrators) {
      scene::Scene scene;
      add(scene, scene::box(Vec3(1)), medium_boundary(m));
      scene.environment.tint = Rgb(1);
      Document d = test::document(std::move(scene), look_at({0.5f, 1, 3}, Vec3(0), {0, 1, 0}, 0.8f), 8, 8);
      const film::Film film =
          test::rendered(with(with_integrator(d, name), (std::string(name) + ".max-depth").c_str(), "64"), 4);
      EXPECT_EQ(film.invalid_samples().total(), 0U) << name;
      EXPECT_TRUE(std::isfinite(test::mean_of(film).value)) << name;
    }
}

std::string refusal(const Document& d, const std::string& integrator) {
  const Document chosen = with(with_integrator(d, integrator), "camera.lens-radius", "0.1");
  return render::incompatibility(chosen, *scene::compile(chosen.scene, chosen.camera, nullptr));
}

TEST(Refusal, OfIntegratorsWithoutHeterogeneousMedia) {
  for (const MediumDescription& m :
       {with_density(medium(Rgb(1)), "ball"), with_density(medium(Rgb(0), Rgb(1)), "ball")})
    for (const auto& info : integrator::integrator_infos()) {
      const std::string reason = refusal(scene_with(m), info.name);
      EXPECT_EQ(reason.empty(), info.heterogeneous_media) << info.name << ": " << reason;
      EXPECT_EQ(reason.find("heterogeneous media") == std::string::npos, info.heterogeneous_media) << reason;
    }
}

TEST(Refusal, OfIntegratorsWithoutMediaThatEmit) {
  for (const MediumDescription& m :
       {emitting(medium(Rgb(0), Rgb(1)), Rgb(1)), with_density(emitting(medium(Rgb(1), Rgb(1)), Rgb(1)), "ball")})
    for (const auto& info : integrator::integrator_infos()) {
      const std::string reason = refusal(scene_with(m), info.name);
      const bool supported = info.emitting_media && (info.heterogeneous_media || !m.is_heterogeneous());
      EXPECT_EQ(reason.empty(), supported) << info.name << ": " << reason;
      EXPECT_TRUE(info.emitting_media || !info.heterogeneous_media ||
                  reason.find("media that emit light") != std::string::npos)
          << reason;
    }
}

TEST(Refusal, OfMediaThatCannotBeRendered) {
  scene::Scene scene = test::balls();
  scene.environment.tint = Rgb(1);
  scene.atmosphere.medium = with_density(medium(Rgb(1)), "exponential");
  EXPECT_NE(refusal(test::view_from_above(scene), "path").find("set atmosphere.radius"), std::string::npos);
  EXPECT_NE(refusal(scene_with(with_density(medium(Rgb(1)), "file")), "path").find("parameter 'file'"),
            std::string::npos);
}

std::string media_decision(const MediumDescription& m) {
  const Document d = scene_with(m);
  for (const auto& decision : transport::model_for(*scene::compile(d.scene, d.camera, nullptr)).decisions)
    if (decision.flag == "media") return decision.value + ": " + decision.reason;
  return {};
}

TEST(Model, StatesWhyAMediumIsHeterogeneous) {
  EXPECT_EQ(media_decision(with_density(medium(Rgb(1)), "ball")),
            "heterogeneous: the density of the medium in material 'boundary' varies");
  EXPECT_EQ(media_decision(emitting(medium(Rgb(0), Rgb(1)), Rgb(1))),
            "homogeneous emitting: the medium in material 'boundary' emits light");
  EXPECT_EQ(media_decision(medium(Rgb(1))), "homogeneous scattering: material 'boundary' scatters inside");
}

}  // namespace
}  // namespace etendue::heterogeneous
