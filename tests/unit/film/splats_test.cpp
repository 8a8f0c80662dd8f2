// Splats at their filter-sampled pixel against the filter shares of all pixels.
#include <gtest/gtest.h>

#include "base/hash.h"
#include "film/splats.h"

namespace etendue::film {
namespace {

class EveryFilterKind : public testing::TestWithParam<FilterKind> {};

// For many splats at one position, each pixel receives the share of its filter, and all pixels together the sum. For
// this number of splats the shares have a standard deviation of 0.0004; the tolerance of 0.002 is 5 sigma.
TEST_P(EveryFilterKind, PixelsReceiveTheShareOfTheirFilter) {
  const Filter filter(GetParam());
  const SplatFilter splats(filter, 9, 9);
  constexpr uint32_t kDraws = 400'000;
  for (const Vec2 at : {Vec2(4.5f, 4.5f), Vec2(4.02f, 4.97f), Vec2(4.31f, 4.6f)}) {
    std::vector<double> got(81, 0);
    for (uint32_t i = 0; i < kDraws; ++i) {
      const Vec2 u(to_unit_float(mix_bits(2 * i)), to_unit_float(mix_bits(2 * i + 1)));
      if (const auto to = splats.choose(at, u)) got[to->pixel] += double{to->weight} / kDraws;
    }
    for (int y = 0; y < 9; ++y)
      for (int x = 0; x < 9; ++x) {
        const float dx = at.x - (static_cast<float>(x) + 0.5f), dy = at.y - (static_cast<float>(y) + 0.5f);
        EXPECT_NEAR(got[static_cast<size_t>(9 * y + x)], double{filter.value(dx)} * double{filter.value(dy)}, 0.005)
            << x << ' ' << y << " at " << at.x << ' ' << at.y;
      }
  }
}

INSTANTIATE_TEST_SUITE_P(SplatFilter, EveryFilterKind,
                         testing::Values(FilterKind::box, FilterKind::tent, FilterKind::gaussian,
                                         FilterKind::blackman_harris));

TEST(SplatFilter, SplatsOutsideTheImageAreDropped) {
  const Filter filter(FilterKind::blackman_harris);
  const SplatFilter splats(filter, 4, 3);
  EXPECT_FALSE(splats.reaches({-1.6f, 1}) || splats.reaches({1, 4.6f}));
  EXPECT_TRUE(splats.reaches({-1.4f, 1}) && splats.reaches({5.4f, 2}));
  for (uint32_t i = 0; i < 1000; ++i) {
    const Vec2 u(to_unit_float(mix_bits(2 * i)), to_unit_float(mix_bits(2 * i + 1)));
    const auto to = splats.choose({-0.3f, 3.1f}, u);
    EXPECT_TRUE(!to || to->pixel == 8u);
  }
}

TEST(Splats, ListsAreSummedByBands) {
  const std::vector<Splats> lists{{{0, Rgb(1)}, {5, Rgb(2)}}, {{5, Rgb(3)}, {11, Rgb(4)}}};
  std::vector<Rgb> picture(12, Rgb(0)), bands = picture;
  add_rows(lists, 4, 0, 3, picture);
  for (int row = 0; row < 3; ++row) add_rows(lists, 4, row, row + 1, bands);
  for (size_t i = 0; i < picture.size(); ++i) EXPECT_EQ(picture[i].r, bands[i].r);
  EXPECT_EQ(picture[0].r, 1);
  EXPECT_EQ(picture[5].r, 5);
  EXPECT_EQ(picture[11].r, 4);
}

}  // namespace
}  // namespace etendue::film
