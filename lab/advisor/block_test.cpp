#include "advisor/block_test.h"

#include <algorithm>
#include <cmath>

namespace etendue::advisor {
namespace {

constexpr double kFalseAlarms = 1e-3;  // per image

// The two-sided quantile of the normal distribution: |x| exceeds it with this probability.
double normal_quantile(double probability) {
  double low = 0, high = 40;
  while (high - low > 1e-6) {
    const double middle = 0.5 * (low + high);
    (std::erfc(middle / std::sqrt(2.0)) > probability ? low : high) = middle;
  }
  return low;
}

struct Sums {
  double difference = 0, variance = 0;
};

// The blocks of an image, row by row.
class BlockGrid {
 public:
  explicit BlockGrid(const film::Film& film)
      : width_(film.width()), across_(blocks(film.width())), down_(blocks(film.height())) {
    sums_.resize(static_cast<size_t>(across_ * down_));
  }

  Sums& block_of_pixel(size_t i) {
    const int x = static_cast<int>(i) % width_, y = static_cast<int>(i) / width_;
    return sums_[static_cast<size_t>(y / BlockTest::kSide * across_ + x / BlockTest::kSide)];
  }

  // The average variance of the block and its neighbours.
  double pooled_variance(size_t block) const {
    const int x0 = static_cast<int>(block) % across_, y0 = static_cast<int>(block) / across_;
    double sum = 0;
    int count = 0;
    for (int y = std::max(0, y0 - 1); y <= std::min(down_ - 1, y0 + 1); ++y)
      for (int x = std::max(0, x0 - 1); x <= std::min(across_ - 1, x0 + 1); ++x, ++count)
        sum += sums_[static_cast<size_t>(y * across_ + x)].variance;
    return sum / count;
  }

  Block test(size_t block) const {
    const double variance = std::max(sums_[block].variance, pooled_variance(block));
    const int x = static_cast<int>(block) % across_, y = static_cast<int>(block) / across_;
    const double difference = sums_[block].difference;
    constexpr double kRounding = 1e-12;  // variance of rounding errors, for images without noise
    return {.x = x * BlockTest::kSide,
            .y = y * BlockTest::kSide,
            .sigmas = difference / std::sqrt(std::max(variance, kRounding))};
  }

  size_t size() const { return sums_.size(); }

 private:
  static int blocks(int pixels) { return (pixels + BlockTest::kSide - 1) / BlockTest::kSide; }

  int width_, across_, down_;
  std::vector<Sums> sums_;
};

}  // namespace

BlockTest test_blocks(const TestedImage& tested, const film::Film& other) {
  BlockGrid grid(other);
  for (size_t i = 0; i < other.pixels().size(); ++i) {
    const auto& pixel = other.pixels()[i];
    const double n = pixel.count[0] + pixel.count[1];
    double difference = 0, deviation = 0;
    for (size_t c = 0; c < 3; ++c) {
      const double a = pixel.sum[0][c] / pixel.count[0], b = pixel.sum[1][c] / pixel.count[1];
      const double other_variance = sqr(0.5 * (a - b));
      double tested_variance = tested.samples > 0 ? other_variance * n / tested.samples : 0;
      if (!tested.variance.empty()) tested_variance = std::max(tested_variance, double{tested.variance[3 * i + c]});
      difference += double{tested.rgb[3 * i + c]} - 0.5 * (a + b);
      deviation += std::sqrt(tested_variance + other_variance);  // upper bound: fully correlated channels
    }
    Sums& sums = grid.block_of_pixel(i);
    sums.difference += difference;
    sums.variance += sqr(deviation);
  }
  BlockTest test;
  test.blocks = grid.size();
  test.max_sigmas = normal_quantile(kFalseAlarms / static_cast<double>(grid.size()));
  for (size_t b = 0; b < grid.size(); ++b)
    if (const Block block = grid.test(b); std::abs(block.sigmas) > test.max_sigmas) test.changed.push_back(block);
  std::ranges::stable_sort(test.changed, std::ranges::greater(), [](const Block& b) { return std::abs(b.sigmas); });
  return test;
}

}  // namespace etendue::advisor
