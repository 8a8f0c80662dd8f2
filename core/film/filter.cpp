#include "film/filter.h"

#include <vector>

#include "base/vectorize.h"

namespace etendue::film {
namespace {

constexpr float kGaussianSigma = 0.5f, kGaussianRadius = 1.5f;
constexpr float kBlackmanHarrisRadius = 1.5f;

double gaussian(double x) { return std::exp(-0.5 * x * x / (kGaussianSigma * kGaussianSigma)); }

// Four-term Blackman-Harris window over [-radius, radius] [Harris 1978].
double blackman_harris(double x) {
  const double t = 2 * 3.14159265358979323846 * (0.5 + 0.5 * x / kBlackmanHarrisRadius);
  return 0.35875 - 0.48829 * std::cos(t) + 0.14128 * std::cos(2 * t) - 0.01168 * std::cos(3 * t);
}

// One filter in one dimension.
struct Kernel {
  float radius;
  double (*shape)(double x);  // not normalised, for x in [0, radius]
  float (*density)(float x);  // normalised, for |x| <= radius
};

// In the order of FilterKind.
constexpr Kernel kKernels[] = {
    {.radius = 0.5f, .shape = [](double) { return 1.0; }, .density = [](float) { return 1.0f; }},
    {.radius = 1, .shape = [](double x) { return 1 - x; }, .density = [](float x) { return 1 - std::abs(x); }},
    {.radius = kGaussianRadius,
     .shape = gaussian,
     .density =
         [](float x) {
           const float integral =
               kGaussianSigma * std::sqrt(2 * kPi) * std::erf(kGaussianRadius / (kGaussianSigma * std::sqrt(2.0f)));
           return static_cast<float>(gaussian(x)) / integral;
         }},
    {.radius = kBlackmanHarrisRadius,
     .shape = blackman_harris,
     .density = [](float x) { return static_cast<float>(blackman_harris(x) / (0.35875 * 2 * kBlackmanHarrisRadius)); }},
    {.radius = 0, .shape = [](double) { return 1.0; }, .density = [](float) { return 0.0f; }},
};
static_assert(std::size(kKernels) == Options<FilterKind>::kOptions.size());

const Kernel& kernel(FilterKind kind) { return kKernels[static_cast<size_t>(kind)]; }

}  // namespace

struct Filter::Tables {
  PositionTable positions;
  SumTable sums;
};

Filter::Filter(FilterKind kind) : kind_(kind) {
  static const auto tables = [] {
    std::array<Tables, std::size(kKernels)> all;
    for (size_t i = 0; i < all.size(); ++i) {
      const auto k = static_cast<FilterKind>(i);
      all[i] = {.positions = tabulate_positions(k), .sums = tabulate_sums(k)};
    }
    return all;
  }();
  positions_ = tables[static_cast<size_t>(kind)].positions.data();
  sums_ = tables[static_cast<size_t>(kind)].sums.data();
}

Filter::SumTable Filter::tabulate_sums(FilterKind kind) {
  SumTable table;
  for (size_t i = 0; i < table.size(); ++i) {
    const float t = static_cast<float>(i) / kSumCells;
    float sum = 0;
    for (size_t k = 0; k < table[i].size(); ++k) {
      sum += value(kind, t + 1 - static_cast<float>(k));
      table[i][k] = sum;
    }
  }
  return table;
}

Filter::PositionTable Filter::tabulate_positions(FilterKind kind) {
  // The integral of the filter from its end inwards, on cells that are small enough for the midpoint rule.
  constexpr int kCells = 1 << 15;
  const double radius = Filter::radius(kind), width = radius / kCells;
  std::vector<double> mass(kCells + 1);
  for (int cell = 0; cell < kCells; ++cell) {
    const auto i = static_cast<size_t>(cell);
    mass[i + 1] = mass[i] + kernel(kind).shape(radius - (cell + 0.5) * width);
  }
  PositionTable positions;
  size_t cell = 0;
  for (size_t i = 0; i < positions.size(); ++i) {
    const double target = mass.back() * std::pow(static_cast<double>(i) / kPositionCells, 4);
    while (cell + 1 < kCells && mass[cell + 1] < target) ++cell;
    const double inside = (target - mass[cell]) / (mass[cell + 1] - mass[cell]);
    positions[i] = static_cast<float>(radius - (static_cast<double>(cell) + inside) * width);
  }
  positions.back() = 0;
  return positions;
}

ETENDUE_VECTORIZE void Filter::sample_all(float* u, size_t count) const {
  for (size_t i = 0; i < padded_lanes(count); ++i) u[i] = inverse(u[i]);
}

float Filter::radius(FilterKind kind) { return kernel(kind).radius; }

float Filter::value(FilterKind kind, float x) { return std::abs(x) > radius(kind) ? 0 : kernel(kind).density(x); }

}  // namespace etendue::film
