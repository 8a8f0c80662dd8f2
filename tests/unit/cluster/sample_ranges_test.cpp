// Sets of sample numbers.
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "cluster/sample_ranges.h"

namespace etendue::cluster {
namespace {

TEST(SampleRanges, JoinWhereTheyMeet) {
  SampleRanges set;
  set.add({4, 6});
  set.add({0, 2});
  EXPECT_EQ(set.ranges(), (std::vector<SampleRange>{{0, 2}, {4, 6}}));
  EXPECT_EQ(set.first_gap(10), (SampleRange{2, 4}));
  set.add({2, 4});
  EXPECT_EQ(set.ranges(), (std::vector<SampleRange>{{0, 6}}));
  EXPECT_EQ(set.first_gap(10), (SampleRange{6, 10}));
  EXPECT_TRUE(set.first_gap(6).is_empty());
}

TEST(SampleRanges, BehaveAsSetsOfNumbers) {
  std::mt19937 random(1);
  SampleRanges set;
  std::vector<bool> expected(40);
  for (int i = 0; i < 2000; ++i) {
    const uint32_t first = random() % 40, end = first + random() % (41 - first);
    const bool adds = random() % 2 == 0;
    if (adds)
      set.add({first, end});
    else
      set.remove({first, end});
    for (uint32_t n = first; n < end; ++n) expected[n] = adds;
    uint32_t count = 0;
    for (uint32_t n = 0; n < 40; ++n) {
      count += expected[n] ? 1 : 0;
      ASSERT_EQ(set.contains({n, n + 1}), expected[n]) << i;
    }
    ASSERT_EQ(set.count(), count);
    for (size_t r = 1; r < set.ranges().size(); ++r) ASSERT_LT(set.ranges()[r - 1].end, set.ranges()[r].first);
  }
}

}  // namespace
}  // namespace etendue::cluster
