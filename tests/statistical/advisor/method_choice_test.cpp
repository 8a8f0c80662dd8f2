// The automatic choice of the integrator. Costs are weighted rays or injected, so no test depends on the speed of the
// machine.
#include "advisor/method_choice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "advisor/choice_revision.h"
#include "advisor/integrator_costs.h"
#include "advisor/minimised_error.h"
#include "advisor/reference_integrator.h"
#include "scene/builtin/builtin.h"
#include "scene/compiled_scene.h"
#include "statistical/advisor/test_scenes.h"

namespace etendue::test {
namespace {

using advisor::ConsideredMethod;
using advisor::MethodChoice;

render::Document automatic(render::Document d, uint32_t samples = 32) {
  d.automatic.enabled = true;
  d.limits = {samples, 0, 0};
  return d;
}

render::Document builtin(const std::string& name, int size) {
  return automatic(sized(*render::new_document(name), size));
}

MethodChoice chosen(const render::Document& d, const advisor::ChoiceOptions& options = {}) {
  render::Session session({2});
  auto choice = advisor::choose_method(session, d, never_cancel, options);
  EXPECT_TRUE(choice) << choice.error().message;
  return choice ? *choice : MethodChoice{};
}

const ConsideredMethod& of(const MethodChoice& choice, const std::string& name) {
  return *std::ranges::find(choice.considered, name, &ConsideredMethod::name);
}

std::string refusal_of(const render::Document& d, const std::string& name) {
  const auto scene = scene::compile(d.scene, d.camera, nullptr);
  for (const auto& m : advisor::allowed_methods(d, *scene))
    if (m.method.integrator == name) return m.refusal;
  return "unknown";
}

// The error of an image with 16 times the samples of a pilot. With the points of a sequence it falls faster than with
// independent random numbers. The seeds are fixed, so the result is the same in every run.
TEST(MethodComparison, PredictsTheErrorOfMoreSamples) {
  const auto d = sized(*render::new_document("cornell"), 64);
  constexpr uint32_t kSamples = 32;
  constexpr double kGrowth = 16;
  render::Session session({2});
  for (const char* sampler : {"sobol", "random"}) {
    // A race needs a second method; it is the same one.
    std::vector<advisor::ComparedMethod> methods(2);
    for (auto& m : methods) m.method = changed(d, "sampler", sampler).method;
    const auto raced = [&](const advisor::ComparisonPlan& plan) {
      return advisor::compare_methods(session, d, methods, plan, never_cancel).methods[0];
    };
    advisor::ComparisonPlan plan{.cost = advisor::ray_cost, .budget = 1e12, .max_samples = kSamples, .seed = 5};
    plan.horizon = kGrowth * raced(plan).cost / plan.budget;
    const advisor::ComparedMethod m = raced(plan);
    ASSERT_EQ(m.samples, kSamples);
    render::Document longer = d;
    longer.method = m.method;
    const auto film = rendered(longer, kSamples * static_cast<uint32_t>(kGrowth));
    const double error = advisor::measured_error(film, plan.measure, d.display.transform()).value;
    EXPECT_NEAR(m.predicted_error / error, 1, 0.15) << sampler;
    const double rate = std::log(std::sqrt(m.noise) / m.predicted_error) / std::log(kGrowth);
    if (std::string(sampler) == "sobol")
      EXPECT_GT(rate, 0.52);
    else
      EXPECT_NEAR(rate, 0.5, 0.04);
  }
}

// A glass sphere under a small light: light through the glass is hard for camera paths, which hit the light by chance.
// Views through the glass, which no candidate samples well, are left out.
TEST(MethodChoice, CausticsOfSmallLightsAreNotPathTraced) {
  const MethodChoice choice = chosen(changed(builtin("glass-caustic", 64), "film.paths", "EDS*L"));
  EXPECT_EQ(choice.method.integrator, "bdpt");
  EXPECT_EQ(choice.considered.front().name, "bdpt");
  EXPECT_NE(choice.reason.find("bdpt has the smallest predicted relative error"), std::string::npos) << choice.reason;
  EXPECT_FALSE(choice.by_time);
}

// An object under a uniform sky.
TEST(MethodChoice, OpenDiffuseScenesAreRenderedFromTheCamera) {
  scene::Scene scene;
  add(scene, sphere(1, 16, false), diffuse(Rgb(0.7f)));
  scene.environment.tint = Rgb(1);
  const Camera camera = look_at({0, 1, 5}, {0, 0, 0}, {0, 1, 0}, 0.8f);
  const MethodChoice choice = chosen(automatic(document(std::move(scene), camera, 64, 64)));
  EXPECT_TRUE(choice.method.integrator.starts_with("path")) << choice.reason;
}

TEST(MethodChoice, IsReproducibleWithoutATimeLimit) {
  const auto d = builtin("cornell-spheres", 48);
  const MethodChoice a = chosen(d), b = chosen(d);
  EXPECT_EQ(a.method, b.method);
  EXPECT_EQ(a.reason, b.reason);
  ASSERT_EQ(a.considered.size(), b.considered.size());
  for (size_t i = 0; i < a.considered.size(); ++i) {
    EXPECT_EQ(a.considered[i].name, b.considered[i].name);
    EXPECT_EQ(a.considered[i].cost, b.considered[i].cost);
    EXPECT_EQ(a.considered[i].pilot_error, b.considered[i].pilot_error);
  }
}

TEST(MethodChoice, AllowedIntegratorsAreRespected) {
  using enum render::AllowedIntegrators;
  auto d = builtin("cornell", 16);
  const auto scene = scene::compile(d.scene, d.camera, nullptr);
  for (const auto allow : {unbiased, consistent, anything}) {
    d.automatic.allow = allow;
    size_t candidates = 0;
    for (const auto& m : advisor::allowed_methods(d, *scene)) {
      if (!m.refusal.empty()) continue;
      ++candidates;
      const auto bias = integrator::find_integrator(m.method.integrator)->bias;
      if (allow == unbiased) {
        EXPECT_EQ(bias, integrator::Bias::unbiased) << m.method.integrator;
      } else if (allow == consistent) {
        EXPECT_NE(bias, integrator::Bias::biased) << m.method.integrator;
      }
    }
    EXPECT_GT(candidates, allow == unbiased ? 2u : 4u);
  }
}

TEST(MethodChoice, IntegratorsThatRefuseTheSceneAreNotCompared) {
  const MethodChoice fog = chosen(builtin("fog", 24));
  EXPECT_NE(of(fog, "appel").refusal.find("scattering media"), std::string::npos);
  EXPECT_EQ(of(fog, "appel").samples, 0u);
  EXPECT_TRUE(integrator::find_integrator(fog.method.integrator)->scattering_media);
  const MethodChoice prism = chosen(builtin("prism", 24));
  EXPECT_NE(of(prism, "bdpt").refusal.find("spectral"), std::string::npos);
  EXPECT_TRUE(integrator::find_integrator(prism.method.integrator)->spectral);
}

TEST(MethodChoice, IncompleteIntegratorsAreRefused) {
  const auto d = builtin("cornell", 16);
  EXPECT_NE(refusal_of(d, "appel").find("does not find the paths"), std::string::npos);
  EXPECT_EQ(refusal_of(d, "light"), "");  // there are no specular surfaces
  EXPECT_NE(refusal_of(builtin("cornell-spheres", 16), "light").find("does not find the paths"), std::string::npos);
  // Direct light alone is complete if only that is requested.
  EXPECT_EQ(refusal_of(changed(d, "film.paths", "E[D|G]L"), "appel"), "");
}

TEST(MethodChoice, SpecialCasesAreCandidatesOnlyWhereTheyDiffer) {
  EXPECT_EQ(refusal_of(builtin("cornell", 16), "path-manifold"),
            "without mirrors and smooth glass it is the same as path");
  EXPECT_EQ(refusal_of(builtin("cornell-spheres", 16), "path-manifold"), "");
}

TEST(MethodChoice, TheMaximumPathDepthIsThatOfTheDocument) {
  const auto d = changed(builtin("cornell", 16), "path.max-depth", "3");
  const auto scene = scene::compile(d.scene, d.camera, nullptr);
  for (const auto& m : advisor::allowed_methods(d, *scene)) {
    if (!m.refusal.empty()) continue;
    render::Document other = d;
    other.method = m.method;
    EXPECT_EQ(*render::get(other, m.method.integrator + ".max-depth"), Value(int64_t{3})) << m.method.integrator;
  }
}

// Path tracing misses caustics of point lights; the reference integrator then is a bidirectional one.
TEST(MethodChoice, CausticsOfPointLightsNeedABidirectionalIntegrator) {
  const auto d = automatic(glossy_scene_under(false, false, true, 32));
  const auto scene = scene::compile(d.scene, d.camera, nullptr);
  EXPECT_EQ(advisor::with_reference_integrator(d, *scene).method.integrator, "bdpt");
  EXPECT_NE(refusal_of(d, "path").find("of point lights"), std::string::npos);
  const auto lit_by_area = automatic(glossy_scene_under(true, false, false, 32));
  const auto other = scene::compile(lit_by_area.scene, lit_by_area.camera, nullptr);
  EXPECT_EQ(advisor::with_reference_integrator(lit_by_area, *other).method.integrator, "path");
  EXPECT_EQ(refusal_of(lit_by_area, "path"), "");
}

// The costs are injected: the integrator that costs nothing wins.
// The rule for samplers: errors of independent random numbers differ by chance.
TEST(MethodChoice, SamplersChangeOnlyForAClearGain) {
  const auto compared = [](double error, double relative_width) {
    advisor::ComparedMethod m;
    m.error.value = m.predicted_error = error;
    m.error.interval = {error * (1 - relative_width), error * (1 + relative_width)};
    return m;
  };
  const auto present = compared(1, 0.5);
  EXPECT_TRUE(advisor::is_clearly_better(compared(0.8, 0.1), present));
  EXPECT_FALSE(advisor::is_clearly_better(compared(0.8, 0.3), present)) << "its interval contains the present error";
  EXPECT_FALSE(advisor::is_clearly_better(compared(0.97, 0.001), present)) << "the gain is too small";
  EXPECT_FALSE(advisor::is_clearly_better(compared(1.2, 0.1), present));
  EXPECT_FALSE(advisor::is_clearly_better(compared(0, 0), present)) << "a pilot without error proves nothing";
}

TEST(MethodChoice, VariantsReplaceTheirPlainFormOnlyForAClearGain) {
  const auto order = [](double variant_error, double variant_width) {
    const auto compared = [](const char* integrator, double error, double relative_width) {
      advisor::ComparedMethod m;
      m.method.integrator = integrator;
      m.error.value = m.predicted_error = error;
      m.error.interval = {error * (1 - relative_width), error * (1 + relative_width)};
      return m;
    };
    std::vector<advisor::ComparedMethod> methods{compared("bdpt-guided", variant_error, variant_width),
                                                 compared("path", 0.9, 0.1), compared("bdpt", 1, 0.1)};
    advisor::demote_unclear_variants(methods);
    std::string names;
    for (const auto& m : methods) names += m.method.integrator + " ";
    return names;
  };
  EXPECT_EQ(order(0.5, 0.1), "bdpt-guided path bdpt ");
  EXPECT_EQ(order(0.8, 0.5), "path bdpt bdpt-guided ");
  EXPECT_EQ(order(0.97, 0.001), "path bdpt bdpt-guided ");
  EXPECT_EQ(order(INFINITY, 0.1), "bdpt-guided path bdpt ") << "nothing is known";
}

TEST(MethodChoice, UsesTheGivenCosts) {
  for (const std::string cheap : {"path", "bdpt"}) {
    const auto cost = [&](const render::Status& status, const render::MethodSettings& method) {
      return static_cast<double>(status.rays) * (method.integrator == cheap ? 1e-3 : 1);
    };
    EXPECT_EQ(chosen(builtin("cornell", 24), {.cost = cost}).method.integrator, cheap);
  }
}

TEST(MethodChoice, EveryIntegratorHasAMeasuredCost) {
  for (const auto& info : integrator::integrator_infos())
    EXPECT_TRUE(advisor::has_measured_cost(info.name)) << info.name << ": measure it with bench/methods_bench";
  EXPECT_GT(advisor::time_per_ray("path-guided"), 1.5 * advisor::time_per_ray("path"));
}

// FLIP is not proportional to noise: four times the samples divide it by less than two.
TEST(MethodChoice, MinimisesFlip) {
  auto d = builtin("spot-indirect", 48);
  d.automatic.error = render::MinimisedError::flip;
  const MethodChoice choice = chosen(d);
  EXPECT_NE(choice.reason.find("predicted FLIP"), std::string::npos) << choice.reason;
  for (const char* name : {"path", "bdpt"}) {
    EXPECT_GT(of(choice, name).predicted_error, 0);
    EXPECT_LT(of(choice, name).predicted_error, of(choice, name).pilot_error + 0.1);
  }
  EXPECT_EQ(nlohmann::json::parse(advisor::choice_json(choice))["error"], "flip");

  // Where FLIP is small, its power is proportional to noise.
  render::Document path = builtin("cornell", 64);
  path.method.sampler = "random";
  const auto display = d.display.transform();
  const auto error = [&](uint32_t samples) {
    return advisor::measured_error(render::rendered(path, samples, 2), d.automatic.error, display);
  };
  const double few = error(16).value, many = error(64).value;
  EXPECT_NEAR(few / many, 2, 0.3);
  EXPECT_LT(advisor::shown_error(d.automatic.error, few) / advisor::shown_error(d.automatic.error, many), 1.8);
}

// The measured FLIP agrees with the FLIP of an image against an accurate one.
TEST(MethodChoice, FlipOfHalfBuffersIsThatOfTheImage) {
  render::Document d = builtin("cornell", 64);
  d.method.sampler = "random";
  const auto display = d.display.transform();
  const film::Film reference = render::rendered(d, 2048, 2);
  d.seed = 5;
  const film::Film film = render::rendered(d, 16, 2);
  const auto flip = render::MinimisedError::flip;
  const double stated = advisor::measured_error(film, flip, display).value;
  const double difference = std::sqrt(advisor::squared_error(film, reference, flip, display).value);
  EXPECT_NEAR(stated / difference, 1, 0.15);
}

// The comparison is made with one set of costs, and revised with others.
TEST(ChoiceRevision, FollowsLongerPilots) {
  const auto cheap = [](const std::string& name) {
    return [name](const render::Status& status, const render::MethodSettings& method) {
      return static_cast<double>(status.rays) * (method.integrator == name ? 1e-9 : 1e-6);
    };
  };
  auto d = builtin("cornell", 24);
  d.limits = {0, 1000, 0};
  render::Session session({2});
  double now = 0;
  const auto clock = [&] { return now += 1e-3; };
  auto choice = advisor::choose_method(session, d, never_cancel, {.cost = cheap("path"), .clock = clock});
  ASSERT_TRUE(choice) << choice.error().message;
  ASSERT_EQ(choice->method.integrator, "path");
  ASSERT_TRUE(advisor::is_revisable(*choice));
  MethodChoice same = *choice, other = *choice;
  const std::string second = choice->finalists[1].method.integrator;
  const auto kept =
      advisor::revised_choice(session, d, same, 1000, never_cancel, {.cost = cheap("path"), .clock = clock});
  EXPECT_FALSE(kept.changes_method()) << kept.reason;
  for (auto& m : other.finalists) m.cost = m.method.integrator == "path" ? 1000 * m.cost : 1e-3 * m.cost;
  const auto changed =
      advisor::revised_choice(session, d, other, 1e6, never_cancel, {.cost = cheap(second), .clock = clock});
  EXPECT_TRUE(changed.changes_method());
  EXPECT_EQ(changed.method.integrator, second);
  EXPECT_NE(changed.reason.find(second + " instead of path"), std::string::npos) << changed.reason;
  const double weight = changed.earlier_weight(1, 3);
  EXPECT_GT(weight, 0);
  EXPECT_LT(weight, 0.25);  // the worse method has a smaller weight than its share of the time
}

TEST(ChoiceRevision, WeightedMeanOfFilms) {
  film::Film a(2, 1), b(2, 1);
  for (int i = 0; i < 3; ++i)
    for (uint32_t half = 0; half < film::kHalfBuffers; ++half) a.add(0, 0, half, Rgb(half == 0 ? 1.0f : 2.0f));
  b.add(0, 0, 0, Rgb(5));
  b.add(0, 0, 1, Rgb(6));
  b.add(1, 0, 0, Rgb(7));
  const film::Film mean = advisor::weighted_mean(a, b, 0.75);
  EXPECT_FLOAT_EQ(mean.half_buffer_mean(0, 0, 0).r, 2);
  EXPECT_FLOAT_EQ(mean.half_buffer_mean(0, 0, 1).g, 3);
  EXPECT_EQ(mean.half_buffer_samples(0, 0, 0), 4u);
  EXPECT_FLOAT_EQ(mean.half_buffer_mean(1, 0, 0).b, 7);  // the other film has no sample here
  EXPECT_EQ(mean.half_buffer_samples(1, 0, 1), 0u);
}

// A clock that advances by one second at every reading: the budget of a time limit is used up at once.
TEST(MethodChoice, AShortTimeLimitKeepsTheIntegrator) {
  auto d = builtin("glass-caustic", 32);
  d.limits = {0, 1, 0};
  double now = 0;
  const MethodChoice choice = chosen(d, {.clock = [&] { return now += 1; }});
  EXPECT_EQ(choice.method.integrator, "path");
  EXPECT_NE(choice.reason.find("time limit is too short"), std::string::npos) << choice.reason;
  EXPECT_TRUE(choice.by_time);
}

// No integrator renders a diffusion profile with wavelengths.
TEST(MethodChoice, FailsIfNoIntegratorIsAllowed) {
  auto d = test::changed(builtin("wax", 16), "material.1.model", "subsurface");
  d.method.color = transport::ColorMode::spectral;
  render::Session session({2});
  const auto choice = advisor::choose_method(session, d, never_cancel);
  ASSERT_FALSE(choice);
  EXPECT_NE(choice.error().message.find("path: "), std::string::npos) << choice.error().message;
}

TEST(MethodChoice, IsInterrupted) {
  render::Session session({2});
  const auto choice =
      advisor::choose_method(session, builtin("cornell", 32), [](double, const std::string&) { return false; });
  ASSERT_TRUE(choice);
  EXPECT_TRUE(choice->interrupted);
}

TEST(MethodChoice, IsReportedAsJson) {
  const auto d = builtin("cornell", 24);
  const MethodChoice choice = chosen(d);
  const auto j = nlohmann::json::parse(advisor::choice_json(choice));
  EXPECT_EQ(j["integrator"], choice.method.integrator);
  EXPECT_EQ(j["reason"], choice.reason);
  EXPECT_EQ(j["error"], "relative");
  EXPECT_EQ(j["cost_unit"], "rays");
  EXPECT_EQ(j["methods"].size(), integrator::integrator_infos().size());
  const auto resolved = advisor::with_choice(d, choice);
  EXPECT_TRUE(resolved.automatic.enabled);
  EXPECT_FALSE(resolved.automatic.is_pending());
  EXPECT_EQ(resolved.method, choice.method);
}

}  // namespace
}  // namespace etendue::test
