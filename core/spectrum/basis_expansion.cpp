#include "spectrum/basis_expansion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace etendue {
namespace {

constexpr double kRange = kLastWavelength - kFirstWavelength;

// The integral from 380 to 780 nm by the midpoint rule, in steps of a quarter of a nanometre.
template <class F>
double integral(F&& f) {
  constexpr int kSteps = 1600;
  constexpr double kStep = kRange / kSteps;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) sum += f(kFirstWavelength + (i + 0.5) * kStep);
  return sum * kStep;
}

using Equations = std::vector<std::vector<double>>;  // each row: coefficients and right side

// Gaussian elimination with pivoting.
std::vector<double> solve(Equations a) {
  const size_t n = a.size();
  for (size_t column = 0; column < n; ++column) {
    size_t pivot = column;
    for (size_t row = column + 1; row < n; ++row)
      if (std::abs(a[row][column]) > std::abs(a[pivot][column])) pivot = row;
    std::swap(a[pivot], a[column]);
    for (size_t row = 0; row < n; ++row) {
      if (row == column) continue;
      const double factor = a[row][column] / a[column][column];
      for (size_t j = column; j <= n; ++j) a[row][j] -= factor * a[column][j];
    }
  }
  std::vector<double> x(n);
  for (size_t i = 0; i < n; ++i) x[i] = a[i][n] / a[i][i];
  return x;
}

}  // namespace

double BasisExpansion::function(size_t i, double wavelength) const {
  const auto count = static_cast<double>(coefficients_.size()), number = static_cast<double>(i);
  const double t = (wavelength - kFirstWavelength) / kRange;
  switch (basis_) {
    case SpectralBasis::boxes:
    case SpectralBasis::samples:
      return std::min(std::floor(t * count), count - 1) == number ? 1 : 0;
    case SpectralBasis::trigonometric: {
      const double angle = 2 * std::numbers::pi * std::ceil(number / 2) * t;
      return i % 2 == 1 ? std::cos(angle) : i == 0 ? 1 : std::sin(angle);
    }
    case SpectralBasis::gaussians: {
      constexpr double kHalfWidth = 1.5;  // full width at half maximum over the distance of the centres
      const double x = (t * count - number - 0.5) / kHalfWidth;
      return std::exp(-std::numbers::ln2 * 4 * x * x);
    }
  }
  return 0;
}

BasisExpansion::BasisExpansion(SpectralBasis basis, size_t count, const Spectrum& spectrum)
    : BasisExpansion(basis, std::clamp<size_t>(count, 1, kMostFunctions)) {
  const size_t n = coefficients_.size();
  if (basis == SpectralBasis::samples) {
    for (size_t i = 0; i < n; ++i)
      coefficients_[i] = spectrum(kFirstWavelength + kRange * (static_cast<double>(i) + 0.5) / static_cast<double>(n));
    return;
  }
  Equations equations(n, std::vector<double>(n + 1));
  for (size_t i = 0; i < n; ++i) {
    for (size_t j = 0; j < n; ++j)
      equations[i][j] = integral([&](double w) { return function(i, w) * function(j, w); });
    equations[i][n] = integral([&](double w) { return function(i, w) * spectrum(w); });
  }
  coefficients_ = solve(std::move(equations));
}

BasisExpansion BasisExpansion::of_color(SpectralBasis basis, const std::array<double, 3>& rgb) {
  BasisExpansion expansion(basis, 3);
  Equations equations(3, std::vector<double>(4));
  for (size_t c = 0; c < 3; ++c) equations[c][3] = rgb[c];
  for (size_t i = 0; i < 3; ++i) {
    const auto of_function = relative_rgb_of([&](double w) { return expansion.function(i, w); });
    for (size_t c = 0; c < 3; ++c) equations[c][i] = of_function[c];
  }
  expansion.coefficients_ = solve(std::move(equations));
  return expansion;
}

double BasisExpansion::operator()(double wavelength) const {
  double sum = 0;
  for (size_t i = 0; i < coefficients_.size(); ++i) sum += coefficients_[i] * function(i, wavelength);
  return sum;
}

Xyz BasisExpansion::xyz() const {
  Xyz sum;
  for (size_t i = 0; i < coefficients_.size(); ++i) {
    const double c = coefficients_[i];
    sum.x += c * integral([&](double w) { return function(i, w) * observer_at(w).x; });
    sum.y += c * integral([&](double w) { return function(i, w) * observer_at(w).y; });
    sum.z += c * integral([&](double w) { return function(i, w) * observer_at(w).z; });
  }
  return sum;
}

double BasisExpansion::relative_error(const Spectrum& spectrum) const {
  const double squared = integral([&](double w) { return std::pow((*this)(w)-spectrum(w), 2); });
  const double norm = integral([&](double w) { return std::pow(spectrum(w), 2); });
  return norm > 0 ? std::sqrt(squared / norm) : 0;
}

}  // namespace etendue
