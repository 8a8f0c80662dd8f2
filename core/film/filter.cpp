#include "film/filter.h"

namespace etendue::film {
namespace {

constexpr float kGaussianSigma = 0.5f, kGaussianRadius = 1.5f;
constexpr float kBlackmanHarrisRadius = 1.5f;
constexpr int kTable = 512;

// Four-term Blackman-Harris window over [-radius, radius] (Harris 1978).
double blackman_harris(double x) {
  const double t = 2 * 3.14159265358979323846 * (0.5 + 0.5 * x / kBlackmanHarrisRadius);
  return 0.35875 - 0.48829 * std::cos(t) + 0.14128 * std::cos(2 * t) - 0.01168 * std::cos(3 * t);
}

double gaussian(double x) { return std::exp(-0.5 * x * x / (kGaussianSigma * kGaussianSigma)); }

// The inverse of the cumulative distribution, by fine summation: errors of 1e-4 pixel.
template <class F>
std::vector<float> tabulate_inverse(F&& f, double radius) {
  constexpr int kSteps = 1 << 14;
  std::vector<double> cdf(kSteps + 1, 0.0);
  for (int i = 0; i < kSteps; ++i)
    cdf[static_cast<size_t>(i) + 1] = cdf[static_cast<size_t>(i)] + f(radius * (2 * (i + 0.5) / kSteps - 1));
  std::vector<float> inverse(kTable + 1);
  size_t at = 0;
  for (int k = 0; k <= kTable; ++k) {
    const double wanted = cdf.back() * k / kTable;
    while (at + 1 < kSteps && cdf[at + 1] < wanted) ++at;
    const double inside = (wanted - cdf[at]) / std::max(cdf[at + 1] - cdf[at], 1e-300);
    inverse[static_cast<size_t>(k)] = static_cast<float>(radius * (2 * (static_cast<double>(at) + inside) / kSteps - 1));
  }
  return inverse;
}

}  // namespace

Filter::Filter(FilterKind kind) : kind_(kind) {
  if (kind == FilterKind::gaussian) inverse_cdf_ = tabulate_inverse(gaussian, kGaussianRadius);
  if (kind == FilterKind::blackman_harris) inverse_cdf_ = tabulate_inverse(blackman_harris, kBlackmanHarrisRadius);
}

float Filter::radius() const {
  switch (kind_) {
    case FilterKind::box: return 0.5f;
    case FilterKind::tent: return 1;
    case FilterKind::gaussian: return kGaussianRadius;
    case FilterKind::blackman_harris: return kBlackmanHarrisRadius;
  }
  return 0;
}

float Filter::value(float x) const {
  if (std::abs(x) > radius()) return 0;
  switch (kind_) {
    case FilterKind::box: return 1;
    case FilterKind::tent: return 1 - std::abs(x);
    case FilterKind::gaussian:
      return static_cast<float>(gaussian(x)) /
             (kGaussianSigma * std::sqrt(2 * kPi) * std::erf(kGaussianRadius / (kGaussianSigma * std::sqrt(2.0f))));
    case FilterKind::blackman_harris: return static_cast<float>(blackman_harris(x) / (0.35875 * 2 * kBlackmanHarrisRadius));
  }
  return 0;
}

float Filter::sample_1d(float u) const {
  switch (kind_) {
    case FilterKind::box: return u - 0.5f;
    case FilterKind::tent: return u < 0.5f ? std::sqrt(2 * u) - 1 : 1 - std::sqrt(2 - 2 * u);
    case FilterKind::gaussian:
    case FilterKind::blackman_harris: break;
  }
  const float at = u * kTable;
  const auto cell = static_cast<size_t>(at);
  const float inside = at - static_cast<float>(cell);
  return inverse_cdf_[cell] * (1 - inside) + inverse_cdf_[cell + 1] * inside;
}

}  // namespace etendue::film
