#include "sampling/counting_sampler.h"

#include <gtest/gtest.h>

namespace etendue {
namespace {

TEST(CountingSampler, HasTheValuesOfItsSampler) {
  for (const auto& info : sampler_infos()) {
    const auto sampler = make_sampler(info.name);
    sampler->prepare(0, 4);
    DimensionCounts counts;
    const CountingSampler counting(*sampler, counts);
    EXPECT_EQ(counting.lane_mask(), sampler->lane_mask()) << info.name;
    EXPECT_EQ(counting.tile_bits(), sampler->tile_bits()) << info.name;
    SampleBlock expected, got;
    sampler->block(17, 3, 2, expected);
    counting.block(17, 3, 2, got);
    EXPECT_EQ(got, expected) << info.name;
  }
}

TEST(CountingSampler, CountsADimensionOncePerSample) {
  const auto sampler = make_sampler("random");
  DimensionCounts counts;
  const CountingSampler counting(*sampler, counts);
  static SampleTable table;
  const std::array<uint32_t, 2> seeds{1, 2};
  for (uint32_t sample = 0; sample < 3; ++sample) {
    counts.begin_sample();
    counting.blocks(seeds, sample, 1, dimensions(2, 2), table);
    counting.blocks(seeds, sample, 1, dimensions(3, 2), table);
    if (sample == 0) counting.blocks({}, sample, 4, dimensions(0, 1), table);
  }
  EXPECT_EQ(counts.at(1, 1), 0U);
  for (const int k : {2, 3, 4}) EXPECT_EQ(counts.at(1, k), 3U) << k;
  EXPECT_EQ(counts.at(4, 0), 0U) << "no path drew it";
  counting.blocks(seeds, 3, DimensionCounts::kBlocks, dimensions(0, 8), table);
  EXPECT_EQ(counts.at(DimensionCounts::kBlocks, 0), 0U) << "later blocks are not counted";
}

}  // namespace
}  // namespace etendue
