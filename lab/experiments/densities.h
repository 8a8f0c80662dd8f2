// Densities on the unit interval and the unit square, with methods that sample them.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <span>

#include "base/parameter.h"
#include "equations/random_numbers.h"

namespace etendue::experiments {

enum class DensityKind { power, exponential, semicircle, peaks, disk, product, ramp };

using SampledPoint = std::array<double, 2>;  // one-dimensional densities use the first coordinate

struct SampledDensity {
  int dimension;
  std::function<double(SampledPoint)> pdf;  // normalised
  double bound;                             // the maximum of the density
  // Empty where there is none in closed form.
  std::function<SampledPoint(equations::RandomNumbers&)> inversion = {}, transformation = {};
};

// p = 3 x^2. The largest of three uniform numbers has this density.
inline SampledDensity power_density() {
  return {.dimension = 1,
          .pdf = [](SampledPoint x) { return 3 * x[0] * x[0]; },
          .bound = 3,
          .inversion =
              [](auto& u) {
                return SampledPoint{std::cbrt(u.uniform()), 0};
              },
          .transformation =
              [](auto& u) {
                const double a = u.uniform(), b = u.uniform(), c = u.uniform();
                return SampledPoint{std::max({a, b, c}), 0};
              }};
}

// p proportional to exp(-5 x), the distance to a collision in a finite medium. The fractional part of an unbounded
// exponential variable has this density.
inline SampledDensity exponential_density() {
  constexpr double kRate = 5;
  const double mass = 1 - std::exp(-kRate);
  return {.dimension = 1,
          .pdf = [mass](SampledPoint x) { return kRate * std::exp(-kRate * x[0]) / mass; },
          .bound = kRate / mass,
          .inversion =
              [mass](auto& u) {
                return SampledPoint{-std::log(1 - u.uniform() * mass) / kRate, 0};
              },
          .transformation =
              [](auto& u) {
                const double distance = -std::log(1 - u.uniform()) / kRate;
                return SampledPoint{distance - std::floor(distance), 0};
              }};
}

// The half circle over the unit interval, scaled to area 1. The coordinate of a uniform point in a disk has it.
inline SampledDensity semicircle_density() {
  return {.dimension = 1,
          .pdf = [](SampledPoint x) { return 8 / std::numbers::pi * std::sqrt(std::max(0.0, x[0] * (1 - x[0]))); },
          .bound = 4 / std::numbers::pi,
          .transformation =
              [](auto& u) {
                const double r = std::sqrt(u.uniform());
                return SampledPoint{0.5 + 0.5 * r * std::cos(2 * std::numbers::pi * u.uniform()), 0};
              }};
}

// p = 1 - cos(4 pi x): two peaks, and zero between them.
inline SampledDensity peaks_density() {
  return {.dimension = 1, .pdf = [](SampledPoint x) { return 1 - std::cos(4 * std::numbers::pi * x[0]); }, .bound = 2};
}

// Uniform in the disk that touches the square [Lang, eq. 6.324-6.332]; the concentric map transforms the square.
inline SampledDensity disk_density() {
  const auto at = [](double r, double angle) {
    return SampledPoint{0.5 + 0.5 * r * std::cos(angle), 0.5 + 0.5 * r * std::sin(angle)};
  };
  return {.dimension = 2,
          .pdf = [](SampledPoint x) { return std::hypot(x[0] - 0.5, x[1] - 0.5) < 0.5 ? 4 / std::numbers::pi : 0.0; },
          .bound = 4 / std::numbers::pi,
          .inversion =
              [at](auto& u) {
                const double r = std::sqrt(u.uniform());
                return at(r, 2 * std::numbers::pi * u.uniform());
              },
          .transformation =
              [at](auto& u) {
                const double x = 2 * u.uniform() - 1, y = 2 * u.uniform() - 1;
                if (x == 0 && y == 0) return at(0, 0);
                return std::abs(x) > std::abs(y) ? at(x, std::numbers::pi / 4 * y / x)
                                                 : at(y, std::numbers::pi / 2 - std::numbers::pi / 4 * x / y);
              }};
}

// p = 2 x 3 y^2, a product of marginals [Lang, eq. 6.279-6.285, corrected]
inline SampledDensity product_density() {
  return {.dimension = 2,
          .pdf = [](SampledPoint x) { return 6 * x[0] * x[1] * x[1]; },
          .bound = 6,
          .inversion =
              [](auto& u) {
                const double x = std::sqrt(u.uniform());
                return SampledPoint{x, std::cbrt(u.uniform())};
              },
          .transformation =
              [](auto& u) {
                const double x = std::max(u.uniform(), u.uniform());
                const double a = u.uniform(), b = u.uniform(), c = u.uniform();
                return SampledPoint{x, std::max({a, b, c})};
              }};
}

// p = x + y: inversion of the marginal x + 1/2 and of the conditional density [Lang, eq. 6.318-6.323]. The mixture of 2x
// and 2y with equal weights has the same density.
inline SampledDensity ramp_density() {
  return {.dimension = 2,
          .pdf = [](SampledPoint x) { return x[0] + x[1]; },
          .bound = 2,
          .inversion =
              [](auto& u) {
                const double x = (std::sqrt(1 + 8 * u.uniform()) - 1) / 2;
                return SampledPoint{x, std::sqrt(x * x + 2 * u.uniform() * (x + 0.5)) - x};
              },
          .transformation =
              [](auto& u) {
                const double linear = std::sqrt(u.uniform()), other = u.uniform();
                return u.uniform() < 0.5 ? SampledPoint{linear, other} : SampledPoint{other, linear};
              }};
}

inline SampledDensity make_density(DensityKind kind) {
  switch (kind) {
    case DensityKind::power:
      return power_density();
    case DensityKind::exponential:
      return exponential_density();
    case DensityKind::semicircle:
      return semicircle_density();
    case DensityKind::peaks:
      return peaks_density();
    case DensityKind::disk:
      return disk_density();
    case DensityKind::product:
      return product_density();
    case DensityKind::ramp:
      return ramp_density();
  }
  return power_density();
}

}  // namespace etendue::experiments

template <>
struct etendue::Options<etendue::experiments::DensityKind> {
  static constexpr std::array<etendue::Option, 7> kOptions{{{"power", "3 x\u00b2"},
                                                            {"exponential", "exp(-5 x), truncated"},
                                                            {"semicircle", "Half circle"},
                                                            {"peaks", "Two peaks"},
                                                            {"disk", "Uniform in a disk"},
                                                            {"product", "2 x \u00b7 3 y\u00b2"},
                                                            {"ramp", "x + y"}}};
};
