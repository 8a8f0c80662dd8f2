// The schedule of ranks, with times that the tests state.
#include "cluster/work_schedule.h"

#include <gtest/gtest.h>

#include "support/cluster_simulation.h"

namespace etendue::cluster {
namespace {

using test::simulate;
using test::SimulatedJob;

// The schedule of two ranks that have measured speeds: one second per sample for rank 0, two for rank 1.
WorkSchedule measured_schedule(uint32_t samples) {
  WorkSchedule schedule(2, samples, {});
  const auto a = schedule.next(0, 0), b = schedule.next(1, 0);
  schedule.complete(0, a->id, 1);
  schedule.complete(1, b->id, 2);
  return schedule;
}

TEST(WorkSchedule, FastRanksReceiveMore) {
  WorkSchedule schedule = measured_schedule(1000);
  const auto fast = schedule.next(0, 2), slow = schedule.next(1, 2);
  ASSERT_TRUE(fast && slow);
  EXPECT_EQ(fast->samples.first, 2U);
  EXPECT_EQ(slow->samples.first, fast->samples.end);
  // At most eight times the piece before.
  EXPECT_EQ(fast->samples.size(), 8U);
  schedule.complete(0, fast->id, 10);
  schedule.complete(1, slow->id, 18);
  EXPECT_EQ(schedule.next(0, 18)->samples.size(), 30U);  // 30 seconds
  EXPECT_EQ(schedule.next(1, 18)->samples.size(), 15U);
}

TEST(WorkSchedule, PiecesShrinkTowardsTheEnd) {
  WorkSchedule schedule(1, 100, {});
  double now = 0;
  uint32_t last = 1000;
  while (const auto piece = schedule.next(0, now)) {
    now += piece->samples.size();
    if (piece->samples.first >= 50) {
      EXPECT_LE(piece->samples.size(), last);
    }
    last = piece->samples.size();
    EXPECT_TRUE(schedule.complete(0, piece->id, now));
  }
  EXPECT_TRUE(schedule.is_finished());
  EXPECT_EQ(schedule.done().ranges(), (std::vector<SampleRange>{{0, 100}}));
  EXPECT_EQ(last, 1U);
}

TEST(WorkSchedule, AnswersOfALateRankCountOnce) {
  WorkSchedule schedule = measured_schedule(4);
  const auto slow = schedule.next(1, 2);
  const auto fast = schedule.next(0, 2);
  ASSERT_TRUE(slow && fast);
  schedule.complete(0, fast->id, 2 + fast->samples.size());
  EXPECT_FALSE(schedule.next(0, 4));  // the other piece is not late yet
  EXPECT_FALSE(schedule.is_late(1, 4));
  EXPECT_TRUE(schedule.is_late(1, 100));
  const auto again = schedule.next(0, 100);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->id, slow->id);
  EXPECT_EQ(schedule.repeated_pieces(), 1U);
  EXPECT_TRUE(schedule.complete(1, slow->id, 101));
  EXPECT_FALSE(schedule.complete(0, again->id, 102));
  EXPECT_TRUE(schedule.is_finished());
  EXPECT_EQ(schedule.done().count(), 4U);
}

TEST(WorkSchedule, PiecesOfDeadRanksAreGivenToOthers) {
  WorkSchedule schedule(2, 10, {});
  const auto lost = schedule.next(1, 0);
  schedule.remove(1);
  EXPECT_EQ(schedule.active_ranks(), 1);
  EXPECT_EQ(schedule.next(0, 1)->samples.first, lost->samples.first);
  EXPECT_FALSE(schedule.complete(1, lost->id, 2));
  EXPECT_FALSE(schedule.next(1, 2));
}

TEST(WorkSchedule, RanksWithDamagedResultsAreExcluded) {
  WorkSchedule schedule(2, 10, {});
  for (int i = 0; i < 3; ++i) {
    const auto piece = schedule.next(1, i);
    ASSERT_TRUE(piece);
    EXPECT_EQ(piece->samples.first, 0U);
    schedule.reject(1);
  }
  EXPECT_FALSE(schedule.next(1, 3));
  EXPECT_EQ(schedule.damaged_results(), 3U);
  EXPECT_EQ(schedule.active_ranks(), 1);
}

TEST(WorkSchedule, ContinuesWithTheMissingSamples) {
  SampleRanges done;
  done.add({0, 3});
  done.add({4, 8});
  WorkSchedule schedule(1, 10, done);
  EXPECT_EQ(schedule.next(0, 0)->samples, (SampleRange{3, 4}));
}

TEST(WorkSchedule, NothingIsBegunAfterTheDeadlineButGapsAreFilled) {
  WorkSchedule schedule = measured_schedule(0);
  schedule.set_deadline(20);
  const auto lost = schedule.next(1, 2);
  const auto piece = schedule.next(0, 2);
  ASSERT_TRUE(lost && piece);
  EXPECT_LE(2 + piece->samples.size(), 20U);
  schedule.complete(0, piece->id, 19.8);
  EXPECT_FALSE(schedule.next(0, 19.8));
  EXPECT_EQ(schedule.samples(), piece->samples.end);
  EXPECT_FALSE(schedule.is_finished());
  schedule.remove(1);
  EXPECT_EQ(schedule.next(0, 21)->samples.first, lost->samples.first);
}

TEST(WorkSchedule, MergingLimitsTheNumberOfPieces) {
  SimulatedJob job{.ranks = 200, .samples = 400'000, .seconds_per_sample = 1, .merge_seconds = 0.05};
  const auto run = simulate(job);
  EXPECT_TRUE(run.is_complete);
  EXPECT_LT(run.merging, 0.25);
  EXPECT_GT(run.utilisation, 0.95);
}

// Ranks of different speeds, some of which are slow at times, die or send damaged results.
TEST(WorkSchedule, ThousandRanksComplete) {
  for (const uint64_t seed : {1, 2, 3}) {
    const SimulatedJob job{.ranks = 1000,
                           .samples = 2'000'000,
                           .seconds_per_sample = 1,
                           .speed_spread = 0.3,
                           .slow_pieces = 0.01,
                           .lifetime = 3600,
                           .damaged_results = 0.001,
                           .bytes_per_result = 8e6,
                           .merge_seconds = 0.01,
                           .seed = seed};
    const auto run = simulate(job);
    EXPECT_TRUE(run.is_complete);
    EXPECT_EQ(run.merged_samples, job.samples);
    EXPECT_GT(run.dead_ranks, 10);
    EXPECT_GT(run.utilisation, 0.5);
  }
}

// Results of ranks 1 to 3 go to the collector 1; those of rank 0 do not.
TEST(WorkSchedule, CollectorsDeliverTheSamplesOfTheirGroup) {
  ScheduleOptions options;
  options.collectors = 1;
  WorkSchedule schedule(4, 4, {}, options);
  for (int rank = 0; rank < 4; ++rank) {
    const auto piece = schedule.next(rank, 0);
    ASSERT_TRUE(piece);
    EXPECT_EQ(piece->collector, rank == 0 ? 0 : 1);
    EXPECT_TRUE(schedule.complete(rank, piece->id, 1));
  }
  EXPECT_EQ(schedule.done().ranges(), (std::vector<SampleRange>{{0, 1}}));
  EXPECT_FALSE(schedule.is_finished());
  EXPECT_EQ(schedule.next_to_collect(1), 1);
  EXPECT_FALSE(schedule.next_to_collect(1));
  EXPECT_FALSE(schedule.late_collector(2));
  EXPECT_TRUE(schedule.deliver(1));
  EXPECT_FALSE(schedule.deliver(1));
  EXPECT_TRUE(schedule.is_finished());
}

TEST(WorkSchedule, SamplesOfAFailedCollectorAreRenderedAgain) {
  ScheduleOptions options;
  options.collectors = 2;
  WorkSchedule schedule(5, 8, {}, options);
  std::vector<Piece> pieces;
  for (int rank = 0; rank < 5; ++rank) pieces.push_back(*schedule.next(rank, 0));
  for (const int rank : {0, 1, 2}) EXPECT_TRUE(schedule.complete(rank, pieces[static_cast<size_t>(rank)].id, 1));
  // Ranks 1 and 3 have the collector 1, which has one sample and will receive another.
  schedule.retire(1);
  EXPECT_EQ(schedule.retired_collectors(), 1U);
  EXPECT_FALSE(schedule.complete(3, pieces[3].id, 2));
  const auto again = schedule.next(3, 2);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->samples.first, pieces[1].samples.first);
  EXPECT_EQ(again->collector, 2);
  EXPECT_FALSE(schedule.deliver(1));
  schedule.retire(2);
  EXPECT_EQ(schedule.next(1, 3)->collector, 0);
}

TEST(WorkSchedule, CollectorsServeMoreRanks) {
  SimulatedJob job{.ranks = 1000,
                   .samples = 500'000,
                   .seconds_per_sample = 2,
                   .speed_spread = 0.3,
                   .bytes_per_result = 118e6,
                   .merge_seconds = 0.3};
  const auto tree = simulate(job);
  EXPECT_TRUE(tree.is_complete);
  EXPECT_EQ(tree.merged_samples, job.samples);
  EXPECT_EQ(tree.collectors, 32);
  job.options.collectors = 0;
  const auto direct = simulate(job);
  EXPECT_TRUE(direct.is_complete);
  EXPECT_GT(tree.utilisation, direct.utilisation + 0.1);
  EXPECT_LT(tree.merging, 0.5 * direct.merging);
}

TEST(WorkSchedule, CollectorsThatDieAreReplaced) {
  for (const uint64_t seed : {1, 2, 3}) {
    const SimulatedJob job{.ranks = 200,
                           .samples = 100'000,
                           .seconds_per_sample = 2,
                           .speed_spread = 0.3,
                           .lifetime = 2000,
                           .damaged_results = 0.001,
                           .bytes_per_result = 118e6,
                           .merge_seconds = 0.3,
                           .seed = seed};
    const auto run = simulate(job);
    EXPECT_TRUE(run.is_complete);
    EXPECT_EQ(run.merged_samples, job.samples);
    EXPECT_GT(run.retired_collectors, 0U);
  }
}

TEST(WorkSchedule, OneRankAloneIsFullyUsed) {
  const auto run = simulate({.ranks = 1, .samples = 1000, .latency = 0});
  EXPECT_TRUE(run.is_complete);
  EXPECT_GT(run.utilisation, 0.99);
}

}  // namespace
}  // namespace etendue::cluster
