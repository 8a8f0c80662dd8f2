// Every group of samples has one point in each stratum                                             [Lang, sec. 6.5.3]
#include <gtest/gtest.h>

#include <set>

#include "base/hash.h"
#include "unit/sampling/points.h"

namespace etendue {
namespace {

// The interval of x among n intervals whose bounds are rounded to float.
int cell_of(float x, int n) {
  auto cell = std::min(static_cast<int>(x * static_cast<float>(n)), n - 1);
  const auto bound = [&](int k) { return static_cast<float>(k) / static_cast<float>(n); };
  while (x < bound(cell)) --cell;
  while (x >= bound(cell + 1)) ++cell;
  return cell;
}

// Dimensions 0-1 and 2-3 of a block fill the grid, the other dimensions the intervals. With 4096 intervals, rounding
// without a limit would move points into the next interval.
TEST(Stratified, GroupsFillAllStrata) {
  for (const int side : {1, 3, 4, 10, 63, 64}) {
    const auto sampler = make_sampler("stratified", {{"side", int64_t{side}}});
    const auto group = static_cast<size_t>(side * side);
    for (uint32_t seed = 0; seed < 5; ++seed) {
      const auto p = test::points(*sampler, mix_bits(seed), static_cast<uint32_t>(2 * group), 2);
      for (const size_t first : {size_t{0}, group})
        for (const size_t d : {0, 2, 4, 5, 6, 7, 8, 10, 12, 15}) {
          std::set<int> cells;
          for (size_t s = first; s < first + group; ++s)
            cells.insert(d % kBlockSize < 4 ? cell_of(p[s][d], side) * side + cell_of(p[s][d + 1], side)
                                            : cell_of(p[s][d], side * side));
          EXPECT_EQ(cells.size(), group) << "side " << side << " dimension " << d;
        }
    }
  }
}

}  // namespace
}  // namespace etendue
