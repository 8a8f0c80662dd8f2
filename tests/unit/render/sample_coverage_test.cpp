// Overlaps and gaps between the parts of a rendering.
#include "render/sample_coverage.h"

#include <gtest/gtest.h>

namespace etendue::render {
namespace {

constexpr int kWidth = 64, kHeight = 32;
constexpr PixelRect kAll{0, 0, kWidth, kHeight};

std::string gap_text(const std::vector<SampleBox>& blocks, uint32_t end) {
  std::string text;
  for (const auto& gap : find_gaps(blocks, kWidth, kHeight, end, 10)) text += text_of(gap, kWidth, kHeight) + "; ";
  return text;
}

TEST(SampleCoverage, RangesThatMeetHaveNoGap) {
  EXPECT_EQ(gap_text({{8, 20, kAll}, {0, 8, kAll}}, 20), "");
  EXPECT_EQ(gap_text({{8, 20, kAll}, {0, 8, kAll}}, 24), "samples 20:24; ");
  EXPECT_EQ(gap_text({{4, 8, kAll}, {10, 12, kAll}}, 12), "samples 0:4; samples 8:10; ");
}

TEST(SampleCoverage, RegionsThatCoverTheImageHaveNoGap) {
  const std::vector<SampleBox> quarters{
      {0, 8, {0, 0, 40, 10}}, {0, 8, {40, 0, 24, 10}}, {0, 8, {0, 10, 5, 22}}, {0, 8, {5, 10, 59, 22}}};
  EXPECT_EQ(gap_text(quarters, 8), "");
  EXPECT_FALSE(find_overlap(quarters));
  EXPECT_EQ(gap_text({quarters[0], quarters[1], quarters[3]}, 8), "samples 0:8 of region 0,10,5,22; ");
}

TEST(SampleCoverage, DifferentDivisionsOfSampleRangesMayMeet) {
  const std::vector<SampleBox> blocks{{0, 4, kAll}, {4, 8, {0, 0, 32, 32}}, {4, 6, {32, 0, 32, 32}}};
  EXPECT_FALSE(find_overlap(blocks));
  EXPECT_EQ(gap_text(blocks, 8), "samples 6:8 of region 32,0,32,32; ");
}

TEST(SampleCoverage, OverlapsAreFound) {
  EXPECT_FALSE(find_overlap(std::vector<SampleBox>{{0, 4, kAll}, {4, 8, kAll}}));
  const auto pair = find_overlap(std::vector<SampleBox>{{4, 8, kAll}, {8, 9, kAll}, {0, 5, {3, 3, 1, 1}}});
  ASSERT_TRUE(pair);
  EXPECT_EQ(*pair, (std::pair<size_t, size_t>{2, 0}));
}

TEST(SampleCoverage, RegionsLieInsideTheImage) {
  EXPECT_TRUE(is_inside(kAll, kWidth, kHeight));
  EXPECT_TRUE(is_inside({kWidth - 1, kHeight - 1, 1, 1}, kWidth, kHeight));
  for (const PixelRect& rect :
       {PixelRect{1, 0, kWidth, 1}, {0, -1, 1, 1}, {0, 0, 0, 1}, {2147483647, 0, 2147483647, 1}})
    EXPECT_FALSE(is_inside(rect, kWidth, kHeight));
}

TEST(SampleCoverage, MeetingRangesAreJoined) {
  const std::vector<SampleBox> blocks{{6, 9, kAll}, {0, 2, kAll}, {2, 4, kAll}, {4, 6, {0, 0, 1, 1}}};
  EXPECT_EQ(joined(blocks), (std::vector<SampleBox>{{4, 6, {0, 0, 1, 1}}, {0, 4, kAll}, {6, 9, kAll}}));
}

}  // namespace
}  // namespace etendue::render
