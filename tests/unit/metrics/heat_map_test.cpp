// Colours of error heat maps.
#include "metrics/heat_map.h"

#include <gtest/gtest.h>

#include "spectrum/colormap.h"

namespace etendue::test {
namespace {

using image::LayeredImage;
using metrics::heat_map;
using metrics::HeatMap;

LayeredImage row(std::vector<float> rgb) {
  LayeredImage image;
  image.width = static_cast<int>(rgb.size() / 3);
  image.height = 1;
  image.layers.push_back({"", {"R", "G", "B"}, std::move(rgb)});
  return image;
}

TEST(HeatMap, RangesFromZeroToTheLargestError) {
  // Differences 0 and far above the mean of the reference.
  const auto map = heat_map(row({1, 1, 1, 100, 100, 100}), row({1, 1, 1, 1, 1, 1}));
  EXPECT_EQ(map, (std::vector<uint8_t>{68, 1, 84, 253, 231, 37}));
}

TEST(HeatMap, SignsAreColours) {
  const auto map = heat_map(row({0, 0, 0, 1, 1, 1, 2, 2, 2}), row({1, 1, 1, 1, 1, 1, 1, 1, 1}), HeatMap::difference);
  ASSERT_EQ(map.size(), 9u);
  EXPECT_GT(map[2], map[0]);  // too dark is blue
  EXPECT_EQ(map[3], map[4]);  // equal is grey
  EXPECT_EQ(map[4], map[5]);
  EXPECT_GT(map[6], map[8]);  // too bright is red
}

TEST(HeatMap, RelativeErrorsAreRelativeToThePixel) {
  // Differences of half the reference, far above the lower bound of the denominator: the same colour.
  const auto map = heat_map(row({15, 15, 15, 150, 150, 150}), row({10, 10, 10, 100, 100, 100}), HeatMap::relmse);
  for (size_t c = 0; c < 3; ++c) EXPECT_EQ(map[c], map[c + 3]);
  const Rgb half = viridis(0.5f);
  EXPECT_NEAR(map[1], half.g * 255, 1);
}

TEST(HeatMap, MapsGivenValuesDirectly) {
  const float map[] = {0, 1};
  EXPECT_EQ(metrics::color_mapped(map), (std::vector<uint8_t>{68, 1, 84, 253, 231, 37}));
}

}  // namespace
}  // namespace etendue::test
