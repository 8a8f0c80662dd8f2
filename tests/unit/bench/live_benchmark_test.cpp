// The live benchmark on small images: scheduling, measurements, and the final state.
#include "bench/live_benchmark.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "bench/benchmark.h"
#include "support/scenes.h"

namespace etendue::test {
namespace {

namespace fs = std::filesystem;
using bench::LiveBenchmark;
using bench::LiveBenchmarkPlan;
using bench::Rule;
using Phase = bench::LiveBenchmarkSnapshot::Phase;
using Snapshot = std::shared_ptr<const bench::LiveBenchmarkSnapshot>;

bool never_cancel(double, const std::string&) { return true; }

class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / ("etendue-live-benchmark-" + std::to_string(::getpid()))) {}
  ~Folder() {
    std::error_code code;
    fs::remove_all(path_, code);
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

LiveBenchmarkPlan plan_of(const render::Document& d, const std::string& methods) {
  LiveBenchmarkPlan plan;
  plan.methods = *bench::parse_methods(methods, d);
  plan.threads = 2;
  return plan;
}

// A live benchmark whose snapshots can be awaited.
class WatchedBenchmark {
 public:
  explicit WatchedBenchmark(LiveBenchmarkPlan plan) : benchmark_(std::move(plan), [this] { wake(); }) {}
  LiveBenchmark& benchmark() { return benchmark_; }

  template <class F>
  Snapshot until(F&& keep_going) {
    Snapshot s;
    std::unique_lock lock(mutex_);
    const bool came = woken_.wait_for(lock, std::chrono::seconds(120), [&] {
      s = benchmark_.snapshot();
      return keep_going(*s);
    });
    EXPECT_TRUE(came);
    return s;
  }
  Snapshot until(Phase phase) {
    return until([&](const auto& s) { return s.phase == phase; });
  }

 private:
  void wake() {
    const std::lock_guard lock(mutex_);
    woken_.notify_all();
  }

  std::mutex mutex_;
  std::condition_variable woken_;
  LiveBenchmark benchmark_;  // declared last, because its thread uses the members above
};

bench::Reference reference_of(const render::Document& d, uint32_t samples) {
  render::Session session({2});
  return bench::render_reference(session, d, {0, samples}, {}, never_cancel);
}

// With a fixed reference, the values equal those of the batch benchmark, and so do the images.
TEST(LiveBenchmark, MeasuresTheSameAsTheBatchBenchmark) {
  const auto d = cornell(12);
  LiveBenchmarkPlan plan = plan_of(d, "path:denoise=regression,path-pure:sampler=random");
  plan.rule = Rule::equal_samples;
  plan.samples = 12;
  plan.repeats = 3;
  plan.seed = 7;
  plan.reference = reference_of(d, 64);
  render::Session session({2});
  const auto bench = bench::run(session, {plan.methods, 0, 12, 3, 7}, *plan.reference, never_cancel);
  WatchedBenchmark watched(plan);
  const auto s = watched.until(Phase::done);
  ASSERT_EQ(s->methods.size(), 2u);
  EXPECT_EQ(s->repeat, 3);
  EXPECT_EQ(s->progress, 1);
  for (size_t m = 0; m < 2; ++m) {
    EXPECT_EQ(s->methods[m].name, plan.methods[m].name);
    const auto &live = s->methods[m].measured.repeats, &still = bench.methods[m].curves.repeats;
    ASSERT_EQ(live.size(), 3u);
    for (size_t r = 0; r < 3; ++r) {
      ASSERT_EQ(live[r].points.size(), still[r].points.size());
      for (size_t i = 0; i < live[r].points.size(); ++i) {
        EXPECT_EQ(live[r].points[i].spp, still[r].points[i].spp);
        EXPECT_EQ(live[r].points[i].mse, still[r].points[i].mse);
        EXPECT_EQ(live[r].points[i].relmse, still[r].points[i].relmse);
        EXPECT_EQ(live[r].points[i].bias, still[r].points[i].bias);
      }
    }
    EXPECT_TRUE(s->methods[m].slope_over_samples.known);
    EXPECT_EQ(s->methods[m].slope_over_samples.degrees, 2);
    ASSERT_TRUE(s->methods[m].frame);
    EXPECT_EQ(s->methods[m].frame->samples, 12u);
  }
}

TEST(LiveBenchmark, SubtractsTheNoiseOfTheReference) {
  const auto d = cornell(12);
  LiveBenchmarkPlan plan = plan_of(d, "path");
  plan.rule = Rule::equal_samples;
  plan.samples = 8;
  plan.repeats = 1;
  plan.reference = reference_of(d, 64);
  WatchedBenchmark watched(plan);
  const auto s = watched.until(Phase::done);
  const auto expected = metrics::without_noise(s->methods[0].measured, *plan.reference->noise);
  for (size_t i = 0; i < expected.repeats[0].points.size(); ++i)
    EXPECT_EQ(s->methods[0].corrected.repeats[0].points[i].mse, expected.repeats[0].points[i].mse);
  EXPECT_EQ(s->reference_error, plan.reference->standard_error());
  EXPECT_EQ(s->reference_samples, 64u);
}

// Checks whether a render ran between two snapshots and whether it was the one with the least time.
bool checked_turn(const bench::LiveBenchmarkSnapshot& before, const bench::LiveBenchmarkSnapshot& after,
                  double budget) {
  double sum = 0, least = INFINITY;
  for (const auto& m : before.methods) {
    sum += m.seconds;
    // A render that has reached the budget does not run again.
    if (m.samples == 0 || m.seconds * (1 + 0.5 / m.samples) < budget) least = std::min(least, m.seconds);
  }
  if (after.reference_seconds > before.reference_seconds) {
    EXPECT_LE(before.reference_seconds, sum);
  }
  for (size_t m = 0; m < after.methods.size(); ++m) {
    if (after.methods[m].seconds == before.methods[m].seconds) continue;
    EXPECT_EQ(before.methods[m].seconds, least);
    EXPECT_GE(before.reference_seconds, sum);
    return true;
  }
  return false;
}

// The scheduled render has the least time so far, and the reference has less time than all renders together.
TEST(LiveBenchmark, TimeIsSharedEqually) {
  LiveBenchmarkPlan plan = plan_of(cornell(24), "path,path-pure:sampler=random,path:max-depth=2");
  plan.seconds = 0.3;
  plan.repeats = 1;
  std::mutex mutex;
  std::unique_ptr<LiveBenchmark> benchmark;
  std::vector<Snapshot> all;
  {
    const std::lock_guard lock(mutex);
    benchmark = std::make_unique<LiveBenchmark>(plan, [&] {
      const std::lock_guard inner(mutex);
      all.push_back(benchmark->snapshot());
    });
  }
  const auto ended = [&] {
    const std::lock_guard lock(mutex);
    return !all.empty() && all.back()->phase == Phase::done;
  };
  while (!ended()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  benchmark.reset();
  size_t turns = 0;
  for (size_t i = 1; i < all.size(); ++i) turns += checked_turn(*all[i - 1], *all[i], plan.seconds);
  EXPECT_GT(turns, 9u);
  for (const auto& m : all.back()->methods) EXPECT_GT(m.seconds, 0);
}

TEST(LiveBenchmark, EqualSamplesEndAtEqualSamples) {
  LiveBenchmarkPlan plan = plan_of(cornell(16), "path,path-pure,path:max-depth=2");
  plan.rule = Rule::equal_samples;
  plan.samples = 21;
  plan.repeats = 2;
  WatchedBenchmark watched(plan);
  const auto s = watched.until(Phase::done);
  for (const auto& m : s->methods) {
    ASSERT_EQ(m.corrected.repeats.size(), 2u);
    for (const auto& curve : m.corrected.repeats) EXPECT_EQ(curve.points.back().spp, 21);
    EXPECT_GT(m.rays_per_second, 0);
  }
}

// 64 times the samples reduce the error to an eighth with random points, and further with Sobol' points.
TEST(LiveBenchmark, ErrorsDecrease) {
  LiveBenchmarkPlan plan = plan_of(cornell(32), "path,path:sampler=random");
  plan.rule = Rule::equal_samples;
  plan.samples = 64;
  plan.repeats = 2;
  plan.reference = reference_of(cornell(32), 2048);
  WatchedBenchmark watched(plan);
  const auto s = watched.until(Phase::done);
  for (const auto& m : s->methods) {
    const auto& points = m.corrected.repeats[0].points;
    EXPECT_LT(points.back().mse, points.front().mse / 16);
    EXPECT_EQ(m.rmse, std::sqrt(points.back().mse));
    EXPECT_LT(m.slope_over_samples.value, -0.3);
  }
}

TEST(LiveBenchmark, ContinuesToTwiceTheBudget) {
  LiveBenchmarkPlan plan = plan_of(cornell(12), "path,path-pure");
  plan.rule = Rule::equal_samples;
  plan.samples = 6;
  plan.repeats = 2;
  WatchedBenchmark watched(plan);
  const auto before = watched.until(Phase::done);
  watched.benchmark().resume();
  const auto after = watched.until([](const auto& s) { return s.phase == Phase::done && s.samples == 12; });
  for (size_t m = 0; m < 2; ++m)
    for (size_t r = 0; r < 2; ++r) {
      const auto &a = before->methods[m].measured.repeats[r].points, &b = after->methods[m].measured.repeats[r].points;
      ASSERT_EQ(a.size(), 5u);
      ASSERT_EQ(b.size(), 7u);
      for (size_t i = 0; i < 5; ++i) EXPECT_EQ(a[i].mse, b[i].mse);
    }
}

TEST(LiveBenchmark, StopsImmediatelyAndContinues) {
  LiveBenchmarkPlan plan = plan_of(cornell(64), "path,path-pure");
  plan.seconds = 1e6;
  WatchedBenchmark watched(plan);
  watched.until([](const auto& s) { return s.methods[1].samples >= 2; });
  watched.benchmark().stop();
  const auto stopped = watched.until(Phase::stopped);
  EXPECT_GE(stopped->methods[1].samples, 2u);
  watched.benchmark().resume();
  watched.until([&](const auto& s) { return s.methods[1].samples > stopped->methods[1].samples; });
}

// A sample of this image takes longer than a user interface may block. The destructor must not wait for it.
TEST(LiveBenchmark, DestructionDoesNotWaitForASample) {
  LiveBenchmarkPlan plan = plan_of(cornell(2048), "path");
  plan.threads = 1;
  plan.reference = bench::Reference{};
  plan.reference->image.width = plan.reference->image.height = 2048;
  plan.reference->image.layers.push_back({"", {"R", "G", "B"}, std::vector<float>(size_t{2048} * 2048 * 3)});
  auto benchmark = std::make_unique<LiveBenchmark>(plan, nullptr);
  benchmark->stop();
  benchmark.reset();
}

TEST(LiveBenchmark, ReferenceIsLoadedExtendedAndStored) {
  const Folder cache;
  const auto d = cornell(16);
  render::Session session({1});
  const auto brief = bench::render_reference(session, d, {0, 4}, cache.path(), never_cancel);
  LiveBenchmarkPlan plan = plan_of(d, "path:sampler=random");
  plan.rule = Rule::equal_samples;
  plan.samples = 256;
  plan.repeats = 2;
  plan.cache = cache.path();
  uint32_t samples = 0;
  {
    WatchedBenchmark watched(plan);
    const auto s = watched.until(Phase::done);
    samples = s->reference_samples;
    EXPECT_GT(samples, brief.samples);
    double methods = 0;
    for (const auto& curve : s->methods[0].measured.repeats) methods += curve.points.back().seconds;
    EXPECT_GE(s->reference_seconds, methods);
  }
  const auto kept = bench::render_reference(session, d, {0, 2}, cache.path(), never_cancel);
  EXPECT_EQ(kept.samples, samples);
  EXPECT_EQ(kept.rgb(), bench::render_reference(session, d, {0, samples}, {}, never_cancel).rgb());
}

TEST(LiveBenchmark, ImagesLargerThanMemoryAreRejected) {
  render::Document d = cornell(8);
  d.width = d.height = 2048;
  LiveBenchmarkPlan plan = plan_of(d, "path,path-pure");
  plan.repeats = 100;
  LiveBenchmark benchmark(plan, nullptr);
  benchmark.stop();
  EXPECT_EQ(benchmark.snapshot()->repeats, 4);
}

}  // namespace
}  // namespace etendue::test
