// Reliability of a rendering: tail statistics of tiles, detection of heavy tails, and the report of a session.
#include "render/reliability.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <functional>
#include <random>

#include "image/image.h"
#include "render/checkpoint.h"
#include "render/session.h"
#include "support/scenes.h"

namespace etendue::render {
namespace {

// A rendering with artificial samples: a function of the pixel and a uniform random number.
std::shared_ptr<const Reliability> reliability_of_samples(int width, int height, uint32_t samples,
                                                          const std::function<float(int, int, double)>& radiance,
                                                          uint64_t seed = 1) {
  film::Film film(width, height);
  TailStatistics tails(width, height);
  std::mt19937_64 engine(seed);
  const auto uniform = [&] { return (static_cast<double>(engine() >> 12) + 0.5) * 0x1p-52; };
  for (uint32_t s = 0; s < samples; ++s)
    for (int y = 0; y < height; y += TailStatistics::kHeight)
      for (int x = 0; x < width; x += TailStatistics::kWidth) {
        const integrator::PixelBlock block{x, y, std::min(TailStatistics::kWidth, width - x),
                                           std::min(TailStatistics::kHeight, height - y), s};
        std::vector<Rgb> colors;
        for (int v = y; v < y + block.height; ++v)
          for (int u = x; u < x + block.width; ++u) colors.emplace_back(radiance(u, v, uniform()));
        tails.add(block, colors, film);
      }
  std::vector<film::Tail> reports;
  for (const auto& tail : tails.tails()) reports.push_back(tail.report());
  const auto all = static_cast<uint64_t>(samples) * film.pixels().size();
  return reliability_of(tails, reports, film.invalid_samples(), all, [] { return true; });
}

float even(double u) { return static_cast<float>(u); }
float pareto(double u, double alpha) { return static_cast<float>(std::pow(u, -1 / alpha)); }

TEST(Reliability, BrightUniformRegionsAreReliable) {
  const auto h =
      reliability_of_samples(40, 20, 64, [](int x, int y, double u) { return x == 7 && y == 3 ? 1e6f : even(u); });
  EXPECT_EQ(h->verdict, Verdict::healthy);
  EXPECT_LT(h->tail.vov, 1e-3);
  EXPECT_LT(h->tail.brightest_share, 1e-4);
  EXPECT_EQ(h->columns, 2);
  EXPECT_EQ(h->rows, 2);
  EXPECT_EQ(h->samples, 62U * 40 * 20);
}

// A hundred tiles, ten of which have tail index k = 1. A tile is missed if its variance of the variance (vov) happens
// to be below the limit, which is the case for one in five.
TEST(Reliability, HeavyTilesAreDetected) {
  int found = 0, alarms = 0;
  for (uint64_t seed = 1; seed <= 5; ++seed) {
    const auto h = reliability_of_samples(
        320, 160, 24, [](int x, int, double u) { return x < 32 ? pareto(u, 1) : even(u); }, seed);
    for (size_t i = 0; i < h->tiles.size(); ++i) (i % 10 == 0 ? found : alarms) += h->tiles[i].heavy ? 1 : 0;
    EXPECT_EQ(h->verdict, Verdict::unreliable);
    EXPECT_NEAR(h->heavy_share, 0.08, 0.03);
  }
  EXPECT_GE(found, 38);
  EXPECT_EQ(alarms, 0);
}

// k = 0.49 everywhere: some tiles appear heavy by chance, which must not be reported.
TEST(Reliability, ChanceDoesNotCauseAnAlarm) {
  int looking = 0;
  for (uint64_t seed = 1; seed <= 8; ++seed) {
    const auto h = reliability_of_samples(
        320, 160, 24, [](int, int, double u) { return pareto(u, 2.05); }, seed);
    for (const auto& t : h->tiles) looking += t.tail.heavy() ? 1 : 0;
    EXPECT_EQ(h->heavy_share, 0) << seed;
    EXPECT_NE(h->verdict, Verdict::unreliable) << seed;
  }
  EXPECT_GT(looking, 0);
}

TEST(Reliability, OneFireflyMakesTheImageUncertain) {
  int drawn = 0;
  const auto h =
      reliability_of_samples(64, 32, 32, [&](int, int, double u) { return ++drawn == 30'000 ? 1e4f : even(u); });
  EXPECT_EQ(h->verdict, Verdict::doubtful);
  EXPECT_GT(h->tail.vov, 0.9);
}

TEST(Reliability, InvalidSamplesAreNoZeros) {
  const auto h = reliability_of_samples(32, 16, 32, [](int x, int, double u) { return x == 3 ? -1 : even(u); });
  EXPECT_EQ(h->verdict, Verdict::unreliable);
  EXPECT_NE(h->reason.find("3.1 %"), std::string::npos) << h->reason;
  EXPECT_TRUE(std::isfinite(h->tail.vov));
}

TEST(Reliability, IsIndependentOfTheNumberOfThreads) {
  auto d = test::cornell(70);
  d.limits.samples = 20;
  std::vector<std::shared_ptr<const Reliability>> all;
  for (const int threads : {1, 2, 7}) {
    Session session({.threads = threads});
    session.submit(d);
    session.finish();
    all.push_back(session.status().reliability);
  }
  for (const auto& h : all) {
    EXPECT_EQ(h->reason, all[0]->reason);
    EXPECT_EQ(h->tail.khat, all[0]->tail.khat);
    for (size_t i = 0; i < h->tiles.size(); ++i) {
      EXPECT_EQ(h->tiles[i].tail.khat, all[0]->tiles[i].tail.khat);
      EXPECT_EQ(h->tiles[i].tail.vov, all[0]->tiles[i].tail.vov);
    }
  }
}

// Preview frames are not included, an edit restarts the statistics, and a loaded film has none.
TEST(Reliability, CoversTheSamplesOfThisRendering) {
  Session session({.threads = 2, .interactive = true, .publish_interval = 0.005});
  for (const int size : {40, 40, 33}) {
    auto d = test::cornell(size);
    d.seed = static_cast<uint64_t>(size);
    d.limits.samples = 12;
    session.submit(d);
    session.finish();
    ASSERT_TRUE(session.status().reliability);
    EXPECT_EQ(session.status().reliability->samples, 10U * size * size);
    session.restart();
    session.finish();
    EXPECT_EQ(session.status().reliability->samples, 10U * size * size);
  }
  auto d = test::cornell(33);
  d.limits.samples = 25;
  session.submit(d, test::rendered(d, 12));
  session.finish();
  EXPECT_EQ(session.status().reliability->samples, 13U * 33 * 33);
}

Document nan_in_a_sky() {
  scene::Scene scene;
  scene.environment.tint = Rgb(1);
  auto map = std::make_shared<image::Image>();
  map->width = 16;
  map->height = 8;
  map->channels = 3;
  map->type = image::PixelType::float32;
  map->floats.assign(16 * 8 * 3, 1.0f);
  map->floats[3 * (4 * 16 + 8)] = std::numeric_limits<float>::quiet_NaN();
  scene.environment.map = map;
  return test::document(std::move(scene), look_at({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 2.5f), 48, 48);
}

TEST(InvalidSamples, TheFirstAreIndependentOfThreadsAndStoredInCheckpoints) {
  const auto one = test::rendered(nan_in_a_sky(), 3, 1).invalid_samples();
  ASSERT_EQ(one.first.size(), film::kListedInvalidSamples);
  EXPECT_EQ(one.first[0].sample, 0U);
  EXPECT_EQ(one.first[0].reason, film::InvalidReason::nan);
  const auto film = test::rendered(nan_in_a_sky(), 3, 7);
  EXPECT_EQ(film.invalid_samples().first, one.first);

  const auto path = std::filesystem::temp_directory_path() / "etendue-rejected.checkpoint";
  ASSERT_TRUE(write_checkpoint(path, {"{}", film, 0}));
  const auto read = read_checkpoint(path);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->film.invalid_samples().first, one.first);
  EXPECT_EQ(read->film.invalid_samples().nan, one.nan);
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 1);
  EXPECT_FALSE(read_checkpoint(path));
  std::filesystem::remove(path);
}

TEST(Fireflies, ReweightingChangesTheImageButNotTheSums) {
  auto d = test::cornell(48);
  d.method.integrator = "path-pure";
  d.limits.samples = 16;
  const auto film = test::rendered(d, 16);
  d.fireflies = film::Fireflies::reweight;
  Session session({.threads = 2, .interactive = true});
  session.submit(d);
  session.finish();
  const film::Film same = session.film_copy();
  EXPECT_EQ(std::memcmp(film.pixels().data(), same.pixels().data(), film.pixels().size_bytes()), 0);
  const auto shown = session.reweighted_copy();
  ASSERT_TRUE(shown);
  while (!session.frame() || session.frame()->samples < 16) std::this_thread::yield();
  const auto frame = session.frame();
  double most = 0;
  for (size_t i = 0; i < frame->pixels->size(); ++i) {
    EXPECT_EQ((*frame->pixels)[i].g, (*shown)[3 * i + 1]);
    const int x = static_cast<int>(i) % 48, y = static_cast<int>(i) / 48;
    EXPECT_LE((*shown)[3 * i + 1], film.mean(x, y).g * 1.0001f);
    most = std::max(most, static_cast<double>(film.mean(x, y).g - (*shown)[3 * i + 1]));
  }
  EXPECT_GT(most, 0.1);

  d.fireflies = film::Fireflies::keep;
  session.submit(d);
  session.finish();
  EXPECT_FALSE(session.reweighted_copy());
}

// Cornell box with 256 samples per pixel: reweighting removes less than half a per cent of the light.
TEST(Fireflies, ImagesWithoutFirefliesAreNearlyUnchanged) {
  auto d = test::cornell(32);
  d.limits.samples = 256;
  d.fireflies = film::Fireflies::reweight;
  Session session({});
  session.submit(d);
  session.finish();
  const auto reweighted = session.reweighted_copy();
  ASSERT_TRUE(reweighted);
  double shown = 0, all = 0;
  for (const float v : *reweighted) shown += static_cast<double>(v);
  const film::Film film = session.film_copy();
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x) all += 3 * static_cast<double>(average(film.mean(x, y)));
  EXPECT_NEAR(shown / all, 1, 0.005);
}

}  // namespace
}  // namespace etendue::render
