#include "film/relative_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/vec.h"

namespace etendue::film {
namespace {

using Numbers = std::array<double, 3>;

// Two-sided, of the normal distribution.
constexpr double kNinetyFivePercent = 1.96;
// Radius of the search for similar pixels, in pixels.
constexpr int kReach = 3;
// Weight of the pixel itself in the mean, so that a pixel without similar ones has a mean; and in the second estimate,
// where it equals that of a similar pixel.
constexpr double kSelfWeight = 0.05, kEqualSelfWeight = 1;
// The same in the mean of the squared errors.
constexpr double kSelfSquareWeight = 0.2;
constexpr double kRelmseOffset = 0.01;
// Rows of the image per range.
constexpr int kBandRows = 64;

struct Offset {
  int x, y;
};
// Every pair of pixels within the search radius has one of these offsets.
constexpr size_t kOffsets = kReach * (2 * kReach + 1) + kReach;

class Estimator {
 public:
  Estimator(int width, int height, std::span<const float> rgb, std::span<const float> variance)
      : width_(width),
        height_(height),
        rgb_(rgb),
        variance_(variance),
        weights_(pixels()),
        sums_(pixels()),
        squares_(pixels()),
        equal_weight_squares_(pixels()),
        slopes_(pixels()),
        difference_(pixels()),
        noise_(pixels()),
        pair_weights_(kOffsets * pixels()) {}

  // The sums over the rows [first, end).
  RelativeErrorSum sums(int first, int end) {
    find_pair_weights();
    for_pairs([&](size_t p, size_t q, double w) {
      gather(p, q, w);
      gather(q, p, w);
    });
    divide();
    std::vector<double> similar_squares(pixels());
    std::vector<Numbers> similar_slopes(pixels());
    const auto add_similar = [&](size_t p, size_t q, double w) {
      similar_squares[p] += w * squares_[q];
      for (size_t c = 0; c < 3; ++c) similar_slopes[p][c] += w * slopes_[q][c];
    };
    for_pairs([&](size_t p, size_t q, double w) {
      add_similar(p, q, w);
      add_similar(q, p, w);
    });
    RelativeErrorSum sum;
    for (size_t p = index(0, first); p < index(0, end); ++p) {
      sum.squares += squares_[p];
      sum.equal_weight_squares += equal_weight_squares_[p];
      sum.fourth += sqr(squares_[p]);
      // The fourth moment of a normal variable is three times the square of its variance.
      sum.missed +=
          squares_[p] * (similar_squares[p] + kSelfSquareWeight * squares_[p] / 3) / (weights_[p] + kSelfSquareWeight);
      double step = 0;  // the errors of the channels are assumed fully correlated, the worst case
      for (size_t c = 0; c < 3; ++c)
        step += (similar_slopes[p][c] + kSelfWeight * slopes_[p][c]) * std::sqrt(double{variance_[3 * p + c]});
      sum.divisor += sqr(step);
    }
    return sum;
  }

 private:
  size_t pixels() const { return static_cast<size_t>(width_) * static_cast<size_t>(height_); }
  size_t index(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x);
  }

  // Calls f(offset, its number) for every offset.
  template <typename F>
  static void for_offsets(const F& f) {
    size_t number = 0;
    for (int y = 0; y <= kReach; ++y)
      for (int x = y > 0 ? -kReach : 1; x <= kReach; ++x) f(Offset{x, y}, number++);
  }
  // Calls f(x, y, pixel) for every pixel that has a partner at this offset.
  template <typename F>
  void for_partners(Offset o, const F& f) const {
    for (int y = 0; y < height_ - o.y; ++y)
      for (int x = first(o); x < end(o); ++x) f(x, y, index(x, y));
  }

  void find_pair_weights() {
    for_offsets([&](Offset o, size_t number) {
      compare(o);
      std::array<size_t, 9> storage;
      size_t count = 0;
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i)
          if (is_compared(i, j, o)) storage[count++] = index(i, j);
      const std::span<const size_t> neighbours(storage.data(), count);
      double* weights = &pair_weights_[number * pixels()];
      for_partners(o, [&](int x, int y, size_t p) {
        const bool inside = x > first(o) && x + 1 < end(o) && y > 0 && y + 1 < height_ - o.y;
        weights[p] = inside ? weight_inside(p, neighbours) : weight(x, y, o);
      });
    });
  }

  // Calls f once for each pair of pixels within the search radius, with their mutual weight.
  template <typename F>
  void for_pairs(const F& f) const {
    for_offsets([&](Offset o, size_t number) {
      const size_t to_partner = static_cast<size_t>(o.y) * static_cast<size_t>(width_) + static_cast<size_t>(o.x);
      for_partners(o, [&](int, int, size_t p) { f(p, p + to_partner, pair_weights_[number * pixels() + p]); });
    });
  }

  // The range of columns whose partner lies in the image.
  int first(Offset o) const { return std::max(0, -o.x); }
  int end(Offset o) const { return width_ - std::max(0, o.x); }

  // The squared difference of each pixel and its partner, and its expectation from noise.
  void compare(Offset o) {
    for_partners(o, [&](int x, int y, size_t p) {
      const size_t q = index(x + o.x, y + o.y);
      double difference = 0, noise = 0;
      for (size_t c = 0; c < 3; ++c) {
        difference += sqr(double{rgb_[3 * p + c]} - double{rgb_[3 * q + c]});
        noise += double{variance_[3 * p + c]} + double{variance_[3 * q + c]};
      }
      difference_[p] = difference;
      noise_[p] = noise;
    });
  }

  // The neighbours of a pixel whose differences are compared: not the pixel and its partner.
  static bool is_compared(int i, int j, Offset o) {
    return !((i == 0 && j == 0) || (i == o.x && j == o.y) || (i == -o.x && j == -o.y));
  }

  // The weight of a pixel and its partner, from the differences of their neighbours.
  double weight(int x, int y, Offset o) const {
    const int left = std::max(-1, first(o) - x), right = std::min(1, end(o) - 1 - x);
    const int top = std::max(-1, -y), bottom = std::min(1, height_ - 1 - o.y - y);
    double difference = 0, noise = 1e-12;
    for (int j = top; j <= bottom; ++j)
      for (int i = left; i <= right; ++i) {
        if (!is_compared(i, j, o)) continue;
        const size_t p = index(x + i, y + j);
        difference += difference_[p];
        noise += noise_[p];
      }
    return weight_of(difference, noise);
  }

  // The same for pixels that are not at the border. `neighbours` are the differences of indices.
  double weight_inside(size_t p, std::span<const size_t> neighbours) const {
    double difference = 0, noise = 1e-12;
    for (const size_t neighbour : neighbours) {
      difference += difference_[p + neighbour];
      noise += noise_[p + neighbour];
    }
    return weight_of(difference, noise);
  }

  static double weight_of(double difference, double noise) { return std::exp(-std::max(0.0, difference / noise - 1)); }

  void gather(size_t p, size_t q, double w) {
    weights_[p] += w;
    for (size_t c = 0; c < 3; ++c) sums_[p][c] += w * double{rgb_[3 * q + c]};
  }

  void divide() {
    for (size_t p = 0; p < pixels(); ++p)
      for (size_t c = 0; c < 3; ++c) {
        const double own = rgb_[3 * p + c], square = variance_[3 * p + c];
        const double r = (sums_[p][c] + kSelfWeight * own) / (weights_[p] + kSelfWeight),
                     divisor = sqr(r) + kRelmseOffset;
        squares_[p] += square / divisor;
        // The derivative of the sum with respect to the radiance of one similar pixel, negated.
        slopes_[p][c] = square * 2 * r / sqr(divisor) / (weights_[p] + kSelfWeight);
        equal_weight_squares_[p] +=
            square / (sqr((sums_[p][c] + kEqualSelfWeight * own) / (weights_[p] + kEqualSelfWeight)) + kRelmseOffset);
      }
  }

  int width_, height_;
  std::span<const float> rgb_, variance_;
  std::vector<double> weights_;  // sums over the other pixels
  std::vector<Numbers> sums_;    // of their weighted radiance
  std::vector<double> squares_;  // relative squared errors, summed over the channels
  std::vector<double> equal_weight_squares_;
  std::vector<Numbers> slopes_;
  std::vector<double> difference_, noise_;
  std::vector<double> pair_weights_;  // by offset, then pixel
};

}  // namespace

RelativeErrorSum relative_error_of_rows(int width, int height, std::span<const float> rgb,
                                        std::span<const float> variance, int first, int end) {
  // Similar pixels are searched twice, and their neighbours compared.
  constexpr int kMargin = 2 * (kReach + 1);
  const int top = std::max(0, first - kMargin), bottom = std::min(height, end + kMargin);
  const size_t row = 3 * static_cast<size_t>(width), offset = row * static_cast<size_t>(top);
  const size_t count = row * static_cast<size_t>(bottom - top);
  return Estimator(width, bottom - top, rgb.subspan(offset, count), variance.subspan(offset, count))
      .sums(first - top, end - top);
}

RelativeError relative_error(std::span<const RelativeErrorSum> sums, double values) {
  RelativeErrorSum all;
  for (const RelativeErrorSum& sum : sums) {
    all.squares += sum.squares;
    all.equal_weight_squares += sum.equal_weight_squares;
    all.missed += sum.missed;
    all.divisor += sum.divisor;
    all.fourth += sum.fourth;
  }
  if (!(all.squares > 0)) return {};
  const double spread = std::sqrt(4 * all.missed + all.divisor) / all.squares;
  const double bias = std::log(all.squares / all.equal_weight_squares);
  // Symmetric in the logarithm, because a mean square is positive and its distribution is skewed.
  const double factor = std::exp(kNinetyFivePercent * std::hypot(spread, bias));
  const double mean = all.squares / values;
  // As in error.cpp.
  const double variation = 0.5 * std::sqrt(2.0 / 3 * all.fourth) / all.squares;
  return {.relmse = mean, .interval = {mean / factor, mean * factor}, .root_variation = variation};
}

RelativeError relative_error(int width, int height, std::span<const float> rgb, std::span<const float> variance) {
  const RelativeErrorSum sum = relative_error_of_rows(width, height, rgb, variance, 0, height);
  return relative_error({&sum, 1}, 3.0 * width * height);
}

std::optional<RelativeError> relative_error(const Film& film, const RangeRunner& given_run) {
  const auto run_here = [](int count, const std::function<void(int, int)>& task) {
    task(0, count);
    return true;
  };
  const RangeRunner run = given_run ? given_run : RangeRunner(run_here);
  const size_t values = film.pixels().size() * 3;
  std::vector<float> rgb(values), variance(values);
  std::vector<char> known(static_cast<size_t>(film.height()), 1);
  const auto copy_rows = [&](int first, int end) {
    for (int y = first; y < end; ++y)
      for (int x = 0; x < film.width(); ++x) {
        const size_t i = static_cast<size_t>(y) * static_cast<size_t>(film.width()) + static_cast<size_t>(x);
        const Film::Pixel& p = film.pixels()[i];
        if (p.count[0] == 0 || p.count[1] == 0) known[static_cast<size_t>(y)] = 0;
        const Rgb mean = film.mean(x, y), v = film.variance_of_mean(x, y);
        for (int c = 0; c < 3; ++c) {
          rgb[3 * i + static_cast<size_t>(c)] = mean[c];
          variance[3 * i + static_cast<size_t>(c)] = v[c];
        }
      }
  };
  if (!run(film.height(), copy_rows) || std::ranges::find(known, 0) != known.end()) return {};
  std::vector<RelativeErrorSum> sums(static_cast<size_t>((film.height() + kBandRows - 1) / kBandRows));
  const auto sum_bands = [&](int first, int end) {
    for (int band = first; band < end; ++band)
      sums[static_cast<size_t>(band)] =
          relative_error_of_rows(film.width(), film.height(), rgb, variance, band * kBandRows,
                                 std::min(film.height(), (band + 1) * kBandRows));
  };
  if (!run(static_cast<int>(sums.size()), sum_bands)) return {};
  return relative_error(sums, static_cast<double>(values));
}

}  // namespace etendue::film
