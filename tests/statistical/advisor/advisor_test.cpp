// The advisor: exclusion of integrators with reasons, ranking by time, and progress reports.
#include "advisor/advisor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "advisor/advice_report.h"
#include "statistical/advisor/test_scenes.h"

namespace etendue::test {
namespace {

using advisor::Advice;
using advisor::Ranking;

Ranking ranked(const render::Document& d, double target, double pilot = 0.1) {
  render::Session session({2});
  advisor::AdviceRequest question;
  question.target = target;
  question.pilot_seconds = pilot;
  return advisor::advise(session, d, question, never_cancel);
}

Advice of(const Ranking& ranking, const std::string& name) {
  return *std::ranges::find_if(ranking.methods, [&](const Advice& a) { return a.method.name == name; });
}

TEST(Advisor, CandidatesAreAllIntegratorsOnce) {
  const auto list = advisor::candidates(cornell(8));
  for (const auto& integrator : integrator::integrator_infos())
    for (const auto& sampler : sampler_infos())
      EXPECT_EQ(std::ranges::count(list, integrator.name + ":sampler=" + sampler.name, &bench::MethodSpec::name),
                sampler.for_study ? 0 : 1);
}

TEST(Advisor, RanksSuitableIntegrators) {
  const Ranking ranking = ranked(cornell(32), 0.01);
  ASSERT_TRUE(ranking.best());
  EXPECT_TRUE(ranking.best()->suitable);
  const Advice biased = of(ranking, "raycast:sampler=sobol");
  EXPECT_FALSE(biased.suitable);
  EXPECT_TRUE(biased.reason.starts_with("biased")) << biased.reason;
  EXPECT_FALSE(biased.time);
  EXPECT_GT(biased.misses.share, 0.1);
  double before = 0;
  for (const Advice& advice : ranking.methods) {
    EXPECT_FALSE(advice.reason.empty());
    if (!advice.time) continue;
    EXPECT_GE(advice.time->seconds, before);
    EXPECT_LE(advice.time->interval.low, advice.time->seconds);
    EXPECT_GE(advice.time->interval.high, advice.time->seconds);
    before = advice.time->seconds;
  }
}

TEST(Advisor, IncompatibleIntegratorsAreNotRanked) {
  // The target error is so large that an image without any path would reach it.
  const Advice hindered = of(ranked(cornell(16), 100, 0.02), "light-pure:sampler=sobol");
  EXPECT_FALSE(hindered.suitable);
  EXPECT_FALSE(hindered.time);
  EXPECT_NE(hindered.reason.find("camera.lens-radius"), std::string::npos) << hindered.reason;
}

TEST(Advisor, MissingPathsCountAgainstTheTarget) {
  const auto d = glossy_scene_under(true, false, true, 24);
  const Advice fine = of(ranked(d, 1e-3, 0.02), "path-pure:sampler=sobol");
  EXPECT_FALSE(fine.suitable);
  EXPECT_TRUE(fine.reason.starts_with("misses ")) << fine.reason;
  // An error larger than the mean of the image is reached without point lights as well.
  EXPECT_TRUE(of(ranked(d, 100, 0.02), "path-pure:sampler=sobol").suitable);
  const Ranking cut = ranked(changed(d, "path.max-depth", "2"), 1e-3, 0.02);
  EXPECT_FALSE(of(cut, "path:sampler=sobol").suitable);
}

// Scenes that few integrators support: scattering media, wavelengths, and diffuse surfaces for radiosity.
TEST(Advisor, RanksIntegratorsOfMedia) {
  const Ranking ranking = ranked(sized(*render::new_document("fog"), 24), 0.05, 0.02);
  ASSERT_TRUE(ranking.best());
  for (const Advice& advice : ranking.methods) {
    const auto* info = integrator::find_integrator(advice.method.document.method.integrator);
    if (info->scattering_media) continue;
    EXPECT_FALSE(advice.suitable) << advice.method.name;
    EXPECT_NE(advice.reason.find("media"), std::string::npos) << advice.reason;
  }
  EXPECT_TRUE(of(ranking, "path:sampler=sobol").suitable);
  EXPECT_TRUE(ranking.table.volumes);
  EXPECT_GT(ranking.table.total.energy.mean, 0);
}

TEST(Advisor, RanksIntegratorsOfSpectralScenes) {
  const Ranking ranking = ranked(sized(*render::new_document("prism"), 24), 0.5, 0.02);
  ASSERT_TRUE(ranking.best());
  for (const Advice& advice : ranking.methods) {
    const auto* info = integrator::find_integrator(advice.method.document.method.integrator);
    if (info->spectral) continue;
    EXPECT_FALSE(advice.suitable) << advice.method.name;
    EXPECT_NE(advice.reason.find("spectral"), std::string::npos) << advice.reason;
  }
  EXPECT_TRUE(integrator::find_integrator(ranking.best()->method.document.method.integrator)->spectral);
}

TEST(Advisor, RadiosityIsBiased) {
  const Ranking ranking = ranked(cornell(16), 0.05, 0.02);
  const Advice radiosity = of(ranking, "radiosity:sampler=sobol");
  EXPECT_FALSE(radiosity.suitable);
  EXPECT_TRUE(radiosity.reason.starts_with("biased")) << radiosity.reason;
  // It renders no scattering media, which is the first reason.
  const Advice in_fog = of(ranked(sized(*render::new_document("fog"), 16), 0.5, 0.02), "radiosity:sampler=sobol");
  EXPECT_NE(in_fog.reason.find("media"), std::string::npos) << in_fog.reason;
}

TEST(Advisor, LargeImagesHaveASmallPilot) {
  auto d = cornell(8);
  d.width = 400;
  d.height = 300;
  render::Session session({2});
  const auto pilots =
      advisor::run_pilots(session, *bench::parse_methods("path", d), {.seconds = 0.05, .target = 1e-3, .max_pixels = 4800}, never_cancel);
  ASSERT_EQ(pilots.pilots.size(), 1u);
  EXPECT_EQ(pilots.pilots[0].method.document.width, 80);
  EXPECT_EQ(pilots.pilots[0].film.height(), 60);
  EXPECT_GT(pilots.size_ratio.seconds, 3);
  EXPECT_NEAR(pilots.size_ratio.error, 1, 0.5);
}

TEST(Advisor, PublishesProgressAndCanBeCancelled) {
  render::Session session({2});
  size_t published = 0;
  advisor::AdviceRequest question;
  question.target = 0.01;
  question.pilot_seconds = 0.02;
  const auto whole =
      advisor::advise(session, cornell(16), question, never_cancel, [&](const Ranking&) { ++published; });
  EXPECT_FALSE(whole.interrupted);
  EXPECT_GT(published, 2u);
  const auto cut =
      advisor::advise(session, cornell(16), question, [](double done, const std::string&) { return done < 0.3; });
  EXPECT_TRUE(cut.interrupted);
}

TEST(Advisor, WritesJsonAndText) {
  const Ranking ranking = ranked(glossy_scene_under(false, false, true, 16), 0.05, 0.02);
  const auto j = nlohmann::json::parse(advisor::ranking_json(ranking, "things"));
  EXPECT_EQ(j["scene"], "things");
  EXPECT_EQ(j["methods"].size(), ranking.methods.size());
  EXPECT_EQ(j["beyond_all_methods"].size(), ranking.beyond_methods.size());
  EXPECT_FALSE(j["table"]["classes"].empty());
  const std::string text = advisor::ranking_text(ranking);
  for (const auto& advice : ranking.methods) EXPECT_NE(text.find(advice.method.name), std::string::npos);
}

}  // namespace
}  // namespace etendue::test
