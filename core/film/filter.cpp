#include "film/filter.h"

#include <vector>

#include "base/vectorize.h"

namespace etendue::film {
namespace {

constexpr float kGaussianSigma = 0.5f, kGaussianRadius = 1.5f;
constexpr float kBlackmanHarrisRadius = 1.5f;

// Four-term Blackman-Harris window over [-radius, radius] (Harris 1978).
double blackman_harris(double x) {
  const double t = 2 * 3.14159265358979323846 * (0.5 + 0.5 * x / kBlackmanHarrisRadius);
  return 0.35875 - 0.48829 * std::cos(t) + 0.14128 * std::cos(2 * t) - 0.01168 * std::cos(3 * t);
}

double gaussian(double x) { return std::exp(-0.5 * x * x / (kGaussianSigma * kGaussianSigma)); }

double tent(double x) { return 1 - x; }
double box(double) { return 1; }

double unnormalised(FilterKind kind, double x) {
  switch (kind) {
    case FilterKind::box:
      return box(x);
    case FilterKind::tent:
      return tent(x);
    case FilterKind::gaussian:
      return gaussian(x);
    case FilterKind::blackman_harris:
      return blackman_harris(x);
    case FilterKind::centre:
      return 1;
  }
  return 0;
}

}  // namespace

Filter::Filter(FilterKind kind) : kind_(kind) {
  struct Tables {
    Table positions;
    SumsTable sums;
  };
  static const auto tables = [] {
    std::array<Tables, Options<FilterKind>::kOptions.size()> all;
    for (size_t i = 0; i < all.size(); ++i) {
      const auto k = static_cast<FilterKind>(i);
      all[i] = {positions(k), sums(k)};
    }
    return all;
  }();
  const Tables& mine = tables[static_cast<size_t>(kind)];
  positions_ = mine.positions.data(), sums_ = mine.sums.data();
}

Filter::SumsTable Filter::sums(FilterKind kind) {
  SumsTable table;
  for (size_t i = 0; i < table.size(); ++i) {
    const float t = static_cast<float>(i) / kSteps;
    float sum = 0;
    for (size_t k = 0; k < table[i].size(); ++k) table[i][k] = sum += value(kind, t + 1 - static_cast<float>(k));
  }
  return table;
}

Filter::Table Filter::positions(FilterKind kind) {
  // Mass from the end of the tail inwards, on cells so small that a constant on each is the filter.
  constexpr int kCells = 1 << 15;
  const double radius = Filter::radius(kind), width = radius / kCells;
  std::vector<double> mass(kCells + 1);
  for (int cell = 0; cell < kCells; ++cell) {
    const auto i = static_cast<size_t>(cell);
    mass[i + 1] = mass[i] + unnormalised(kind, radius - (cell + 0.5) * width);
  }
  Table positions;
  size_t cell = 0;
  for (size_t i = 0; i < positions.size(); ++i) {
    const double wanted = mass.back() * std::pow(static_cast<double>(i) / kTable, 4);
    while (cell + 1 < kCells && mass[cell + 1] < wanted) ++cell;
    const double inside = (wanted - mass[cell]) / (mass[cell + 1] - mass[cell]);
    positions[i] = static_cast<float>(radius - (static_cast<double>(cell) + inside) * width);
  }
  positions.back() = 0;
  return positions;
}

ETENDUE_VECTORIZE void Filter::sample_all(float* u, size_t count) const {
  for (size_t i = 0; i < padded_lanes(count); ++i) u[i] = inverse(u[i]);
}

float Filter::radius(FilterKind kind) {
  switch (kind) {
    case FilterKind::box:
      return 0.5f;
    case FilterKind::tent:
      return 1;
    case FilterKind::gaussian:
      return kGaussianRadius;
    case FilterKind::blackman_harris:
      return kBlackmanHarrisRadius;
    case FilterKind::centre:
      return 0;
  }
  return 0;
}

float Filter::value(FilterKind kind, float x) {
  if (std::abs(x) > Filter::radius(kind)) return 0;
  switch (kind) {
    case FilterKind::box:
      return 1;
    case FilterKind::tent:
      return 1 - std::abs(x);
    case FilterKind::gaussian:
      return static_cast<float>(gaussian(x)) /
             (kGaussianSigma * std::sqrt(2 * kPi) * std::erf(kGaussianRadius / (kGaussianSigma * std::sqrt(2.0f))));
    case FilterKind::blackman_harris:
      return static_cast<float>(blackman_harris(x) / (0.35875 * 2 * kBlackmanHarrisRadius));
    case FilterKind::centre:
      return 0;
  }
  return 0;
}

}  // namespace etendue::film
