#include "support/chi_square.h"

#include <cmath>
#include <vector>

namespace etendue::test {
namespace {

constexpr int kRows = 20, kColumns = 40;
constexpr double kPiD = 3.14159265358979323846;

// Regularised upper incomplete gamma function: series below a + 1, Lentz's continued fraction above.
double upper_gamma(double a, double x) {
  if (x <= 0) return 1;
  const double front = std::exp(-x + a * std::log(x) - std::lgamma(a));
  if (x < a + 1) {
    double term = 1 / a, sum = term;
    for (int n = 1; n < 10'000 && term > sum * 1e-15; ++n) sum += term *= x / (a + n);
    return 1 - sum * front;
  }
  double b = x + 1 - a, c = 1e300, d = 1 / b, h = d;
  for (int i = 1; i < 10'000; ++i) {
    const double an = -i * (i - a);
    b += 2;
    d = 1 / std::max(an * d + b, 1e-300);
    c = b + an / c;
    h *= d * c;
    if (std::abs(d * c - 1) < 1e-15) break;
  }
  return front * h;
}

// Midpoint rule with n x n points over one cell of equal steps in cos theta and phi.
double midpoint(const std::function<double(const Vec3&)>& pdf, int row, int column, int n) {
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double z = -1 + 2 * (row + (i + 0.5) / n) / kRows;
      const double phi = 2 * kPiD * (column + (j + 0.5) / n) / kColumns;
      const double r = std::sqrt(std::max(0.0, 1 - z * z));
      sum += pdf(
          Vec3(static_cast<float>(r * std::cos(phi)), static_cast<float>(r * std::sin(phi)), static_cast<float>(z)));
    }
  return sum / (static_cast<double>(n) * n) * (2.0 / kRows) * (2 * kPiD / kColumns);
}

// Refined until it stands still to a tenth of what the samples can tell: narrow lobes need thousands of points.
double expected_share(const std::function<double(const Vec3&)>& pdf, int row, int column, int samples) {
  double value = midpoint(pdf, row, column, 16);
  for (int n = 32; n <= 512; n *= 2) {
    const double finer = midpoint(pdf, row, column, n);
    const bool settled =
        std::abs(finer - value) < 0.1 * std::sqrt(std::max(finer, 1e-9) / samples) && (finer > 0 || n > 64);
    value = finer;
    if (settled) break;
  }
  return value;
}

}  // namespace

double chi_square_tail(double statistic, int degrees) { return upper_gamma(0.5 * degrees, 0.5 * statistic); }

ChiSquare chi_square_on_sphere(const std::function<bool(Vec3&)>& sample, const std::function<double(const Vec3&)>& pdf,
                               int samples) {
  std::vector<double> counts(kRows * kColumns + 1, 0.0), expected(kRows * kColumns + 1, 0.0);
  for (int i = 0; i < samples; ++i) {
    Vec3 w;
    if (!sample(w)) {
      ++counts.back();
      continue;
    }
    const int row = std::min(kRows - 1, static_cast<int>((w.z + 1) * 0.5f * kRows));
    const double phi = std::atan2(w.y, w.x);
    const int column =
        std::min(kColumns - 1, static_cast<int>((phi < 0 ? phi + 2 * kPiD : phi) / (2 * kPiD) * kColumns));
    ++counts[static_cast<size_t>(row * kColumns + column)];
  }
  double total = 0;
  for (int row = 0; row < kRows; ++row)
    for (int column = 0; column < kColumns; ++column)
      total += expected[static_cast<size_t>(row * kColumns + column)] =
          samples * expected_share(pdf, row, column, samples);
  expected.back() = std::max(0.0, samples - total);

  ChiSquare result;
  double pooled_count = 0, pooled_expected = 0;
  int cells = 0;
  const auto add = [&](double count, double expectation) {
    result.statistic += (count - expectation) * (count - expectation) / expectation;
    ++cells;
  };
  for (size_t i = 0; i < counts.size(); ++i) {
    if (expected[i] >= 5) {
      add(counts[i], expected[i]);
    } else {
      pooled_count += counts[i], pooled_expected += expected[i];
    }
  }
  if (pooled_expected >= 5) add(pooled_count, pooled_expected);
  // Samples where the density is zero.
  if (pooled_expected < 5 && pooled_count > 5 * (pooled_expected + 5)) result.statistic += 1e9;
  result.degrees = std::max(1, cells - 1);
  result.p_value = chi_square_tail(result.statistic, result.degrees);
  return result;
}

}  // namespace etendue::test
