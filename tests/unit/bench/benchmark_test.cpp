// The benchmark from end to end on small images, at equal sample counts: curves are reproducible except for the times.
#include "bench/benchmark.h"
#include "base/base64.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "bench/measurement_schedule.h"
#include "bench/reference_key.h"
#include "bench/report.h"
#include "bench/summary.h"
#include "render/denoised_image.h"
#include "support/scenes.h"

namespace etendue::test {
namespace {

namespace fs = std::filesystem;
using bench::Plan;
using bench::Reference;

render::Document changed(const render::Document& d, const std::string& name, const std::string& value) {
  auto result = render::with_text(d, name, value);
  EXPECT_TRUE(result) << result.error().message;
  return *result;
}

bool never_cancel(double, const std::string&) { return true; }

class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / ("etendue-bench-" + std::to_string(::getpid()))) {}
  ~Folder() {
    std::error_code code;
    fs::remove_all(path_, code);
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

TEST(Methods, AreDocumentsWithTheirParameters) {
  const auto methods = bench::parse_methods("path:sampler=random:roulette-start=7,path-pure", cornell(8));
  ASSERT_TRUE(methods) << methods.error().message;
  ASSERT_EQ(methods->size(), 2u);
  const auto& first = methods->at(0);
  EXPECT_EQ(first.name, "path:sampler=random:roulette-start=7");
  EXPECT_EQ(first.document.method.sampler, "random");
  EXPECT_EQ(to_string(*render::get(first.document, "path.roulette-start")), "7");
  EXPECT_EQ(methods->at(1).document.method.integrator, "path-pure");
  EXPECT_EQ(methods->at(1).document.method.sampler, "sobol");
}

TEST(Methods, ACommaBelongsToTheValueUnlessANameFollows) {
  const auto methods = bench::parse_methods("bdpt:without=1,* 2,3,path,bdpt:only=*,1", cornell(8));
  ASSERT_TRUE(methods) << methods.error().message;
  ASSERT_EQ(methods->size(), 3u);
  EXPECT_EQ(methods->at(0).name, "bdpt:without=1,* 2,3");
  EXPECT_EQ(to_string(*render::get(methods->at(0).document, "bdpt.without")), "1,* 2,3");
  EXPECT_EQ(methods->at(1).document.method.integrator, "path");
  EXPECT_EQ(to_string(*render::get(methods->at(2).document, "bdpt.only")), "*,1");
}

TEST(Methods, SamplerParametersMayPrecedeTheSampler) {
  const auto& samplers = sampler_infos();
  for (const auto& info : samplers) {
    if (info.parameters.empty()) continue;
    const auto& p = info.parameters.front();
    const auto methods =
        bench::parse_methods("path:" + p.name + "=" + to_string(p.default_value) + ":sampler=" + info.name, cornell(8));
    EXPECT_TRUE(methods) << methods.error().message;
  }
}

TEST(Methods, MayNotChangeTheImage) {
  for (const char* setting : {"film.width=9", "material.0.metallic=1", "camera.yfov=1", "render.seed=3", "scene.time=1",
                              "camera.exposure=2", "render.samples=3"}) {
    const auto methods = bench::parse_methods(std::string("path:") + setting, cornell(8));
    ASSERT_FALSE(methods) << setting;
    EXPECT_EQ(methods.error().fault, Fault::usage);
  }
}

// A diffusion profile may stand for a scattering body of the scene; other models may not.
TEST(Methods, MayApproximateSubsurfaceScattering) {
  const auto methods = bench::parse_methods(
      "path,path:material.0.model=dipole:material.0.dipole.eta=1.5,path:material.0.model=subsurface", cornell(8));
  ASSERT_TRUE(methods) << methods.error().message;
  EXPECT_EQ(to_string(*render::get(methods->at(1).document, "material.0.dipole.eta")), "1.5");
  EXPECT_EQ(to_string(*render::get(methods->at(2).document, "material.0.model")), "subsurface");
  EXPECT_FALSE(bench::parse_methods("path:material.0.model=mirror", cornell(8)));
  EXPECT_FALSE(bench::parse_methods("path:material.0.model=dipole:material.0.emission.r=1", cornell(8)));
}

TEST(Methods, MayBeDenoised) {
  const auto methods =
      bench::parse_methods("path,path:denoise=true,path:denoise=false,path:denoise=regression", cornell(8));
  ASSERT_TRUE(methods) << methods.error().message;
  EXPECT_FALSE(methods->at(0).denoiser);
  EXPECT_EQ(methods->at(1).denoiser, render::Denoiser::automatic);
  EXPECT_FALSE(methods->at(2).denoiser);
  EXPECT_EQ(methods->at(3).denoiser, render::Denoiser::regression);
  const auto wrong = bench::parse_methods("path:denoise=yes", cornell(8));
  ASSERT_FALSE(wrong);
  EXPECT_NE(wrong.error().message.find("give one of auto, regression, oidn, true or false"), std::string::npos);
}

// The curve of a denoised method has the errors of the denoised image, which is that of render/denoised_image.h.
TEST(Bench, DenoisedImagesHaveTheirOwnCurve) {
  const auto d = cornell(24);
  render::Session session({2});
  const Reference reference = bench::render_reference(session, d, {0, 512}, {}, never_cancel);
  Plan plan{*bench::parse_methods("path,path:denoise=regression", d), 0, 8, 1, 3};
  const auto outcome = bench::run(session, plan, reference, never_cancel);
  const auto &raw = outcome.methods[0].curves.repeats[0].points,
             &denoised = outcome.methods[1].curves.repeats[0].points;
  ASSERT_EQ(raw.size(), denoised.size() + 1);
  EXPECT_EQ(denoised.front().spp, 2u) << "the noise is the difference of the half-buffers";
  EXPECT_LT(denoised.back().relmse, raw.back().relmse / 2);
  EXPECT_EQ(denoised.back().spp, 8u);
  auto seeded = d;
  seeded.seed = bench::repeat_seed(plan.seed, 1, 0);
  const auto features = render::denoise_features(*session.scene(), seeded, 4, 2);
  const auto image = render::denoised_image(render::rendered(seeded, 8, 2), features, render::Denoiser::regression, 2);
  EXPECT_EQ(outcome.methods[1].image, image->pixels);
}

// An interruption is noticed while the denoiser runs.
TEST(Bench, DenoisingIsInterrupted) {
  const auto d = cornell(96);
  render::Session session({2});
  const Reference reference = bench::render_reference(session, d, {0, 2}, {}, never_cancel);
  const Plan plan{*bench::parse_methods("path:denoise=regression", d), 0, 1, 1, 3};
  int calls = 0;
  const auto outcome = bench::run(session, plan, reference, [&](double, const std::string&) { return ++calls < 4; });
  EXPECT_TRUE(outcome.interrupted);
  EXPECT_TRUE(outcome.methods[0].image.empty());
}

TEST(PictureKey, DependsOnTheImageOnly) {
  const auto d = cornell(8);
  const uint64_t key = bench::image_key(d);
  auto other = d;
  other.seed = 5;
  other.limits.samples = 3;
  other.display.exposure = 2;
  other.scene_name = "elsewhere";
  EXPECT_EQ(bench::image_key(other), key);
  EXPECT_EQ(bench::image_key(cornell(8)), key);
  EXPECT_NE(bench::image_key(cornell(9)), key);
  EXPECT_NE(bench::image_key(changed(d, "film.filter", "box")), key);
  EXPECT_NE(bench::image_key(changed(d, "material.0.metallic", "0.5")), key);
  EXPECT_NE(bench::image_key(changed(d, "path.max-depth", "3")), key);
  EXPECT_NE(bench::image_key(changed(d, "camera.yfov", "0.5")), key);
}

TEST(PictureKey, ChangesWithAVertexPosition) {
  auto d = cornell(8);
  const uint64_t key = bench::image_key(d);
  auto scene = std::make_shared<scene::Scene>(*d.scene);
  auto mesh = std::make_shared<Mesh>(*scene->meshes[0].primitives[0].mesh);
  mesh->positions[0].x += 1e-3f;
  scene->meshes[0].primitives[0].mesh = mesh;
  d.scene = scene;
  EXPECT_NE(bench::image_key(d), key);
}

TEST(Reference, ExtensionIsBitIdentical) {
  const Folder cache;
  render::Session session({1});
  const auto d = cornell(12);
  const auto make = [&](uint32_t samples, const fs::path& folder) {
    return bench::render_reference(session, d, {0, samples}, folder, never_cancel);
  };
  const Reference brief = make(4, cache.path());
  EXPECT_EQ(brief.samples, 4u);
  EXPECT_TRUE(fs::exists(brief.file));
  const Reference longer = make(20, cache.path()), whole = make(20, {});
  EXPECT_EQ(longer.samples, 20u);
  EXPECT_EQ(longer.file, brief.file);
  EXPECT_EQ(whole.file, "");
  EXPECT_EQ(longer.rgb(), whole.rgb());
  // A stored reference with more samples than requested is used unchanged.
  EXPECT_EQ(make(8, cache.path()).samples, 20u);
}

// The two half-buffers of one pixel give a poor estimate of its error; over thousands of pixels the estimate is
// accurate.
TEST(Reference, ErrorFallsWithTime) {
  render::Session session({2});
  const auto error = [&](uint32_t samples) {
    return bench::render_reference(session, cornell(64), {0, samples}, {}, never_cancel).standard_error();
  };
  EXPECT_LT(error(128), 0.6 * error(8));
}

TEST(Reference, ADamagedCacheIsReplaced) {
  const Folder cache;
  render::Session session({1});
  const auto d = cornell(12);
  const auto first = bench::render_reference(session, d, {0, 4}, cache.path(), never_cancel);
  fs::resize_file(first.file, 100);
  const auto second = bench::render_reference(session, d, {0, 4}, cache.path(), never_cancel);
  EXPECT_EQ(second.samples, 4u);
  EXPECT_EQ(first.rgb(), second.rgb());
}

TEST(Reference, MayBeCancelled) {
  render::Session session({1});
  const auto r =
      bench::render_reference(session, cornell(12), {0, 1000000}, {}, [](double, const std::string&) { return false; });
  EXPECT_LT(r.samples, 1000000u);
  EXPECT_EQ(r.rgb().size(), 12u * 12 * 3);
}

TEST(Run, IsReproducibleAtEqualSamples) {
  render::Session session({2});
  const auto d = cornell(12);
  const Reference reference = bench::render_reference(session, d, {0, 64}, {}, never_cancel);
  const Plan plan{*bench::parse_methods("path,path-pure:sampler=random", d), 0, 12, 3, 1};
  const auto a = bench::run(session, plan, reference, never_cancel),
             b = bench::run(session, plan, reference, never_cancel);
  ASSERT_EQ(a.methods.size(), 2u);
  for (size_t m = 0; m < 2; ++m) {
    ASSERT_EQ(a.methods[m].curves.repeats.size(), 3u);
    for (size_t r = 0; r < 3; ++r) {
      const auto &x = a.methods[m].curves.repeats[r].points, &y = b.methods[m].curves.repeats[r].points;
      ASSERT_EQ(x.size(), 7u);
      for (size_t i = 0; i < 7; ++i) {
        EXPECT_EQ(x[i].mse, y[i].mse);
        EXPECT_EQ(x[i].spp, (std::array{1, 2, 3, 4, 6, 8, 12})[i]);
        EXPECT_GT(x[i].seconds, i > 0 ? x[i - 1].seconds : 0);
      }
    }
    // Repeats have different seeds.
    EXPECT_NE(a.methods[m].curves.repeats[0].points[6].mse, a.methods[m].curves.repeats[1].points[6].mse);
  }
}

TEST(Run, MethodsAlternate) {
  render::Session session({1});
  const auto d = cornell(8);
  const Reference reference = bench::render_reference(session, d, {0, 4}, {}, never_cancel);
  const Plan plan{*bench::parse_methods("path,path-pure", d), 0, 2, 2, 0};
  std::vector<std::string> order;
  double last = 0;
  bench::run(session, plan, reference, [&](double done, const std::string& what) {
    if (order.empty() || order.back() != what) order.push_back(what);
    last = done;
    return true;
  });
  EXPECT_EQ(order, (std::vector<std::string>{"path, repeat 1 of 2", "path-pure, repeat 1 of 2", "path, repeat 2 of 2",
                                             "path-pure, repeat 2 of 2"}));
  EXPECT_LE(last, 1);
}

TEST(Run, TimeBudgetIsRespected) {
  render::Session session({2});
  const auto d = cornell(16);
  const Reference reference = bench::render_reference(session, d, {0, 16}, {}, never_cancel);
  const Plan plan{*bench::parse_methods("path", d), 0.1, 0, 1, 0};
  const auto outcome = bench::run(session, plan, reference, never_cancel);
  const auto& end = outcome.methods[0].curves.repeats[0].points.back();
  EXPECT_NEAR(end.seconds, 0.1, 0.05);
  EXPECT_GT(end.spp, 1);
}

TEST(Run, CancellationKeepsCompleteRepeats) {
  render::Session session({1});
  const auto d = cornell(8);
  const Reference reference = bench::render_reference(session, d, {0, 4}, {}, never_cancel);
  const Plan plan{*bench::parse_methods("path", d), 0, 64, 100, 0};
  const auto outcome = bench::run(session, plan, reference,
                                  [](double, const std::string& what) { return !what.starts_with("path, repeat 3"); });
  EXPECT_TRUE(outcome.interrupted);
  EXPECT_EQ(outcome.methods[0].curves.repeats.size(), 2u);
}

// Random sampling has slope -1/2 over samples and no bias. Truncated paths have a bias, which repeats reveal. A
// deviation of five standard errors with five degrees of freedom occurs in one of 240 seeds, for each of both checks.
TEST(Summary, FindsTheSlopeOfRandomSamplingAndABias) {
  render::Session session({2});
  const auto d = cornell(16);
  const Reference reference = bench::render_reference(session, d, {0, 4096}, {}, never_cancel);
  const Plan plan{*bench::parse_methods("path:sampler=random,path:max-depth=2", d), 0, 128, 6, 4};
  const auto outcome = bench::run(session, plan, reference, never_cancel);
  const auto good = bench::summary_of(outcome.methods[0], reference, {});
  EXPECT_NEAR(good.slope_over_samples.value, -0.5, 5 * good.slope_over_samples.standard_error);
  EXPECT_LT(good.slope_over_samples.standard_error, 0.1);
  EXPECT_NEAR(good.bias.value, 0, 5 * good.bias.standard_error);
  EXPECT_FALSE(good.reference_too_noisy);
  // Connections to a light on the ceiling have bounded contributions.
  ASSERT_TRUE(good.khat);
  EXPECT_FALSE(good.has_heavy_tail);
  const auto dark = bench::summary_of(outcome.methods[1], reference, {});
  EXPECT_LT(dark.bias.value, -20 * dark.bias.standard_error);
  ASSERT_TRUE(good.bias_variance && dark.bias_variance);
  EXPECT_GT(dark.bias_variance->squared_bias, 3 * dark.bias_variance->variance);
  EXPECT_LT(std::abs(good.bias_variance->squared_bias), 0.5 * good.bias_variance->variance);
  EXPECT_GT(dark.flip, good.flip);
}

TEST(Report, OfAnEmptyRunIsValid) {
  render::Session session({1});
  const auto d = cornell(8);
  const Reference reference = bench::render_reference(session, d, {0, 2}, {}, never_cancel);
  const Plan plan{*bench::parse_methods("path,path-pure", d), 0, 2, 1, 0};
  const auto outcome = bench::run(session, plan, reference, [](double, const std::string&) { return false; });
  const Folder folder;
  const auto written = bench::write_report(folder.path(), {d, plan, reference, outcome, 1});
  ASSERT_TRUE(written) << written.error().message;
  std::ifstream file(folder.path() / "summary.json");
  const auto j = nlohmann::json::parse(file);
  EXPECT_EQ(j["methods"].size(), 2u);
  EXPECT_TRUE(j["methods"][0]["slope"].is_null());
}

TEST(Base64, MatchesTheStandard) {
  const auto of = [](const std::string& text) { return base64(std::as_bytes(std::span(text))); };
  EXPECT_EQ(of(""), "");
  EXPECT_EQ(of("f"), "Zg==");
  EXPECT_EQ(of("fo"), "Zm8=");
  EXPECT_EQ(of("foo"), "Zm9v");
  EXPECT_EQ(of("foobar"), "Zm9vYmFy");
}

}  // namespace
}  // namespace etendue::test
