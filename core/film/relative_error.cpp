#include "film/relative_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/vec.h"

namespace etendue::film {
namespace {

using Numbers = std::array<double, 3>;

// Of the normal distribution, both sides together.
constexpr double kNinetyFivePercent = 1.96;
// Alike pixels are looked for so far away.
constexpr int kReach = 3;
// What the pixel itself counts among the others, so that one that is like no other has a mean; and in the second
// estimate, as much as one that is alike.
constexpr double kOwn = 0.05, kOwnAsAny = 1;
// The same among the squared errors that stand for each other.
constexpr double kOwnSquare = 0.2;
constexpr double kDark = 0.01;

struct Offset {
  int x, y;
};

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
        slopes_(pixels()),
        apart_(pixels()),
        noise_(pixels()) {}

  RelativeError estimate() {
    for_pairs([&](size_t p, size_t q, double w) { gather(p, q, w), gather(q, p, w); });
    divide();
    if (!(total_ > 0)) return {};
    std::vector<double> alike(pixels());
    std::vector<Numbers> moved(pixels());
    const auto meet = [&](size_t p, size_t q, double w) {
      alike[p] += w * squares_[q];
      for (size_t c = 0; c < 3; ++c) moved[p][c] += w * slopes_[q][c];
    };
    for_pairs([&](size_t p, size_t q, double w) { meet(p, q, w), meet(q, p, w); });
    double missed = 0, divisor = 0;
    for (size_t p = 0; p < pixels(); ++p) {
      // Alone, a normal number's fourth moment is three times the square of its second.
      missed += squares_[p] * (alike[p] + kOwnSquare * squares_[p] / 3) / (weights_[p] + kOwnSquare);
      double step = 0;  // channels err together at worst, and are taken to
      for (size_t c = 0; c < 3; ++c)
        step += (moved[p][c] + kOwn * slopes_[p][c]) * std::sqrt(double{variance_[3 * p + c]});
      divisor += sqr(step);
    }
    const double spread = std::sqrt(4 * missed + divisor) / total_, unlike = std::log(total_ / total_as_any_);
    // Symmetric in the logarithm: a mean square is positive, and its distribution leans to the right.
    const double factor = std::exp(kNinetyFivePercent * std::hypot(spread, unlike));
    const double mean = total_ / (3.0 * static_cast<double>(pixels()));
    return {mean, {mean / factor, mean * factor}};
  }

 private:
  size_t pixels() const { return static_cast<size_t>(width_) * static_cast<size_t>(height_); }
  size_t index(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x);
  }

  // Every pair of pixels within reach, once, with the weight that one has for the other.
  template <typename F>
  void for_pairs(const F& f) {
    for (int y = 0; y <= kReach; ++y)
      for (int x = y > 0 ? -kReach : 1; x <= kReach; ++x) for_pairs_at({x, y}, f);
  }

  template <typename F>
  void for_pairs_at(Offset o, const F& f) {
    compare(o);
    for (int y = 0; y < height_ - o.y; ++y)
      for (int x = first(o); x < end(o); ++x) f(index(x, y), index(x + o.x, y + o.y), weight(x, y, o));
  }

  // Columns of pixels whose partner is in the picture.
  int first(Offset o) const { return std::max(0, -o.x); }
  int end(Offset o) const { return width_ - std::max(0, o.x); }

  // How far each pixel and its partner are apart, squared, and how far noise would set them.
  void compare(Offset o) {
    for (int y = 0; y < height_ - o.y; ++y)
      for (int x = first(o); x < end(o); ++x) {
        const size_t p = index(x, y), q = index(x + o.x, y + o.y);
        double apart = 0, noise = 0;
        for (size_t c = 0; c < 3; ++c) {
          apart += sqr(double{rgb_[3 * p + c]} - double{rgb_[3 * q + c]});
          noise += double{variance_[3 * p + c]} + double{variance_[3 * q + c]};
        }
        apart_[p] = apart, noise_[p] = noise;
      }
  }

  // Of a pixel and its partner, from their neighbours.
  double weight(int x, int y, Offset o) const {
    double apart = 0, noise = 1e-12;
    for (int j = std::max(-1, -y); j <= std::min(1, height_ - 1 - o.y - y); ++j)
      for (int i = std::max(-1, first(o) - x); i <= std::min(1, end(o) - 1 - x); ++i) {
        // Neither of the two has a say.
        if ((i == 0 && j == 0) || (i == o.x && j == o.y) || (i == -o.x && j == -o.y)) continue;
        const size_t p = index(x + i, y + j);
        apart += apart_[p], noise += noise_[p];
      }
    return std::exp(-std::max(0.0, apart / noise - 1));
  }

  void gather(size_t p, size_t q, double w) {
    weights_[p] += w;
    for (size_t c = 0; c < 3; ++c) sums_[p][c] += w * double{rgb_[3 * q + c]};
  }

  void divide() {
    for (size_t p = 0; p < pixels(); ++p)
      for (size_t c = 0; c < 3; ++c) {
        const double own = rgb_[3 * p + c], square = variance_[3 * p + c];
        const double r = (sums_[p][c] + kOwn * own) / (weights_[p] + kOwn), divisor = sqr(r) + kDark;
        squares_[p] += square / divisor;
        // By how much the sum falls as one pixel that is alike is brighter.
        slopes_[p][c] = square * 2 * r / sqr(divisor) / (weights_[p] + kOwn);
        total_ += square / divisor;
        total_as_any_ += square / (sqr((sums_[p][c] + kOwnAsAny * own) / (weights_[p] + kOwnAsAny)) + kDark);
      }
  }

  int width_, height_;
  std::span<const float> rgb_, variance_;
  std::vector<double> weights_;  // of all others
  std::vector<Numbers> sums_;    // of their radiance
  std::vector<double> squares_;  // relative squared errors, channels added up
  std::vector<Numbers> slopes_;
  std::vector<double> apart_, noise_;
  double total_ = 0, total_as_any_ = 0;
};

}  // namespace

RelativeError relative_error(int width, int height, std::span<const float> rgb, std::span<const float> variance) {
  return Estimator(width, height, rgb, variance).estimate();
}

std::optional<RelativeError> relative_error(const Film& film) {
  std::vector<float> rgb, variance;
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x) {
      if (film.half_buffer_samples(x, y, 0) == 0 || film.half_buffer_samples(x, y, 1) == 0) return {};
      const Rgb m = film.mean(x, y), v = film.variance_of_mean(x, y);
      rgb.insert(rgb.end(), {m.r, m.g, m.b}), variance.insert(variance.end(), {v.r, v.g, v.b});
    }
  return relative_error(film.width(), film.height(), rgb, variance);
}

}  // namespace etendue::film
