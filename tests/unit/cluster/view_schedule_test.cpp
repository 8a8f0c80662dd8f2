#include "cluster/view_schedule.h"

#include <gtest/gtest.h>

#include <random>

namespace etendue::cluster {
namespace {

TEST(ViewSchedule, GivesOutEachSampleOnce) {
  constexpr uint32_t kLimit = 1000;
  constexpr int kRanks = 4;
  ViewSchedule schedule(kRanks);
  schedule.begin(kLimit);
  std::mt19937 engine(1);
  std::vector<int> given(kLimit);
  std::vector<std::vector<Piece>> open(kRanks);
  const auto count = [&](const SampleRange& range) {
    for (uint32_t s = range.first; s < range.end; ++s) ++given[s];
  };
  const auto deliver = [&](int rank) {
    std::vector<uint64_t> ids;
    for (const Piece& piece : open[static_cast<size_t>(rank)]) {
      ids.push_back(piece.id);
      count(piece.samples);
      schedule.measure(rank, piece.samples.size(), 0.01 * rank * piece.samples.size());
    }
    EXPECT_TRUE(schedule.deliver(rank, ids));
    EXPECT_TRUE(ids.empty() || !schedule.deliver(rank, ids)) << "the same pieces again";
    open[static_cast<size_t>(rank)].clear();
  };
  for (int i = 0; i < 100'000 && schedule.own_samples() + schedule.delivered_samples() < kLimit; ++i) {
    const int rank = static_cast<int>(engine() % kRanks);
    if (rank == 0) {
      if (const auto sample = schedule.next_own()) ++given[*sample];
    } else if (engine() % 3 == 0) {
      deliver(rank);
    } else if (engine() % 20 == 0) {
      // What the rank delivers later is refused.
      std::vector<uint64_t> ids;
      for (const Piece& piece : open[static_cast<size_t>(rank)]) ids.push_back(piece.id);
      schedule.give_up(rank);
      open[static_cast<size_t>(rank)].clear();
      EXPECT_TRUE(ids.empty() || !schedule.deliver(rank, ids));
    } else if (const auto piece = schedule.next(rank, 0.1)) {
      EXPECT_LE(piece->samples.end, kLimit);
      open[static_cast<size_t>(rank)].push_back(*piece);
    }
  }
  EXPECT_EQ(given, std::vector<int>(kLimit, 1));
  EXPECT_FALSE(schedule.next_own());
  EXPECT_FALSE(schedule.next(1, 0.1));
}

TEST(ViewSchedule, SizesFollowFromSpeeds) {
  ViewSchedule schedule(3);
  schedule.begin(0);
  for (const int rank : {1, 2}) EXPECT_EQ(schedule.next(rank, 1)->samples.size(), 1U);
  schedule.measure(1, 1, 0.01);
  schedule.measure(2, 1, 0.5);
  EXPECT_EQ(schedule.next(1, 1)->samples.size(), 4U);  // a short measurement
  EXPECT_EQ(schedule.next(1, 1)->samples.size(), 16U);
  EXPECT_EQ(schedule.next(1, 1)->samples.size(), 64U);
  EXPECT_EQ(schedule.next(1, 1)->samples.size(), 100U);
  EXPECT_EQ(schedule.next(2, 1)->samples.size(), 2U);
  // The first piece of the next document returns soon.
  schedule.begin(0);
  EXPECT_EQ(schedule.next(1, 1)->samples.size(), 1U);
  EXPECT_TRUE(schedule.is_first(1));
}

TEST(ViewSchedule, ARankThatDeliversNothingWaits) {
  ViewSchedule schedule(2);
  schedule.begin(0);
  size_t pieces = 0;
  while (schedule.next(1, 1)) ASSERT_LT(++pieces, 100U);
  EXPECT_EQ(schedule.undelivered(1), pieces);
  EXPECT_TRUE(schedule.next_own());
}

TEST(ViewSchedule, TheLimitMayChange) {
  ViewSchedule schedule(2);
  schedule.begin(2);
  EXPECT_EQ(*schedule.next_own(), 0U);
  EXPECT_EQ(schedule.next(1, 1)->samples, (SampleRange{1, 2}));
  EXPECT_FALSE(schedule.next_own());
  schedule.set_limit(3);
  EXPECT_EQ(*schedule.next_own(), 2U);
  schedule.set_limit(1);
  EXPECT_FALSE(schedule.next_own());
}

// A film that contains a piece beyond the new limit is refused; its other samples are given out again.
TEST(ViewSchedule, PiecesBeyondALowerLimitAreTakenBack) {
  ViewSchedule schedule(2);
  schedule.begin(0);
  const Piece first = *schedule.next(1, 1);
  schedule.measure(1, 1, 0.1);
  const Piece second = *schedule.next(1, 1);
  ASSERT_EQ(second.samples, (SampleRange{1, 5}));
  schedule.set_limit(3);
  EXPECT_EQ(schedule.undelivered(1), 1U);
  EXPECT_FALSE(schedule.deliver(1, std::vector<uint64_t>{first.id, second.id}));
  EXPECT_EQ(schedule.delivered_samples(), 0U);
  for (const uint32_t sample : {0U, 1U, 2U}) EXPECT_EQ(schedule.next_own(), sample);
  EXPECT_FALSE(schedule.next_own());
}

}  // namespace
}  // namespace etendue::cluster
