#include "film/filter.h"

namespace etendue::film {
namespace {

constexpr float kGaussianSigma = 0.5f, kGaussianRadius = 1.5f;
constexpr float kBlackmanHarrisRadius = 1.5f;
constexpr int kTable = 1024;

// Four-term Blackman-Harris window over [-radius, radius] (Harris 1978).
double blackman_harris(double x) {
  const double t = 2 * 3.14159265358979323846 * (0.5 + 0.5 * x / kBlackmanHarrisRadius);
  return 0.35875 - 0.48829 * std::cos(t) + 0.14128 * std::cos(2 * t) - 0.01168 * std::cos(3 * t);
}

double gaussian(double x) { return std::exp(-0.5 * x * x / (kGaussianSigma * kGaussianSigma)); }

// The filter on cells so small that a constant on each is the filter.
template <class F>
Piecewise1D tabulate(F&& f, double radius) {
  std::vector<float> values(kTable);
  for (int i = 0; i < kTable; ++i)
    values[static_cast<size_t>(i)] = static_cast<float>(f(radius * (2 * (i + 0.5) / kTable - 1)));
  return Piecewise1D(values);
}

}  // namespace

Filter::Filter(FilterKind kind) : kind_(kind) {
  if (kind == FilterKind::gaussian) table_ = tabulate(gaussian, kGaussianRadius);
  if (kind == FilterKind::blackman_harris) table_ = tabulate(blackman_harris, kBlackmanHarrisRadius);
}

float Filter::radius() const {
  switch (kind_) {
    case FilterKind::box:
      return 0.5f;
    case FilterKind::tent:
      return 1;
    case FilterKind::gaussian:
      return kGaussianRadius;
    case FilterKind::blackman_harris:
      return kBlackmanHarrisRadius;
  }
  return 0;
}

float Filter::value(float x) const {
  if (std::abs(x) > radius()) return 0;
  switch (kind_) {
    case FilterKind::box:
      return 1;
    case FilterKind::tent:
      return 1 - std::abs(x);
    case FilterKind::gaussian:
      return static_cast<float>(gaussian(x)) /
             (kGaussianSigma * std::sqrt(2 * kPi) * std::erf(kGaussianRadius / (kGaussianSigma * std::sqrt(2.0f))));
    case FilterKind::blackman_harris:
      return static_cast<float>(blackman_harris(x) / (0.35875 * 2 * kBlackmanHarrisRadius));
  }
  return 0;
}

float Filter::sample_1d(float u) const {
  switch (kind_) {
    case FilterKind::box:
      return u - 0.5f;
    case FilterKind::tent:
      return u < 0.5f ? std::sqrt(2 * u) - 1 : 1 - std::sqrt(2 - 2 * u);
    case FilterKind::gaussian:
    case FilterKind::blackman_harris:
      break;
  }
  return radius() * (2 * table_.sample(u).x - 1);
}

}  // namespace etendue::film
