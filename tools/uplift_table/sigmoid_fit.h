// Fits the coefficients of the spectra of core/spectrum/uplift.h to colours.               [Jakob and Hanika 2019]
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "spectrum/observer.h"

namespace etendue {

using Coefficients = std::array<double, 3>;

inline double normalized(double wavelength) {
  return (wavelength - kFirstWavelength) / (kLastWavelength - kFirstWavelength);
}

inline double sigmoid(double p) { return 0.5 + 0.5 * p / std::sqrt(1 + p * p); }
inline double sigmoid_derivative(double p) { return 0.5 / ((1 + p * p) * std::sqrt(1 + p * p)); }

// Fits coefficients to a colour by the Levenberg-Marquardt method.
class SigmoidFit {
 public:
  SigmoidFit() {
    for (size_t i = 0; i < kWavelengths; ++i) {
      const bool at_end = i == 0 || i + 1 == kWavelengths;
      const auto w = relative_rgb_weights(table_wavelength(i));
      for (size_t c = 0; c < 3; ++c) weights_[i][c] = w[c] * (at_end ? kWavelengthStep / 2 : kWavelengthStep);
      t_[i] = normalized(table_wavelength(i));
    }
  }

  // Improves `c`, the start of the iteration.
  void fit(const Coefficients& color, Coefficients& c) const {
    constexpr int kIterations = 12;
    constexpr double kConverged = 1e-10;  // sum of the squared errors of the components
    double damping = 1e-4;
    System current = linearized(color, c);
    for (int k = 0; k < kIterations && current.error > kConverged; ++k) {
      Coefficients next = step(current, c, damping);
      bound(next);
      const System candidate = linearized(color, next);
      if (candidate.error < current.error) {
        c = next;
        current = candidate;
        damping = std::max(damping * 0.2, 1e-12);
      } else {
        damping *= 10;
        if (damping > 1e8) return;
      }
    }
  }

 private:
  struct System {
    Coefficients residual{};
    std::array<Coefficients, 3> jacobian{};  // by colour component
    double error = 0;
  };

  // Coefficients of saturated colours diverge; beyond this bound the spectrum no longer changes visibly.
  static void bound(Coefficients& c) {
    constexpr double kLargest = 2000;
    const double largest = std::max({std::abs(c[0]), std::abs(c[1]), std::abs(c[2])});
    if (largest <= kLargest) return;
    for (double& value : c) value *= kLargest / largest;
  }

  System linearized(const Coefficients& color, const Coefficients& c) const {
    System s;
    for (size_t k = 0; k < 3; ++k) s.residual[k] = -color[k];
    for (size_t i = 0; i < kWavelengths; ++i) {
      const double t = t_[i], p = (c[0] * t + c[1]) * t + c[2];
      const double value = sigmoid(p), slope = sigmoid_derivative(p);
      for (size_t k = 0; k < 3; ++k) {
        s.residual[k] += weights_[i][k] * value;
        const double d = weights_[i][k] * slope;
        s.jacobian[k][0] += d * t * t;
        s.jacobian[k][1] += d * t;
        s.jacobian[k][2] += d;
      }
    }
    for (const double r : s.residual) s.error += r * r;
    return s;
  }

  // Solves (J^T J + damping diag(J^T J)) x = -J^T r and returns c + x.
  static Coefficients step(const System& s, Coefficients c, double damping) {
    std::array<std::array<double, 4>, 3> a{};
    for (size_t i = 0; i < 3; ++i)
      for (size_t k = 0; k < 3; ++k) {
        for (size_t j = 0; j < 3; ++j) a[i][j] += s.jacobian[k][i] * s.jacobian[k][j];
        a[i][3] -= s.jacobian[k][i] * s.residual[k];
      }
    for (size_t i = 0; i < 3; ++i) a[i][i] += damping * a[i][i] + 1e-30;
    for (size_t column = 0; column < 3; ++column) {
      size_t pivot = column;
      for (size_t row = column + 1; row < 3; ++row)
        if (std::abs(a[row][column]) > std::abs(a[pivot][column])) pivot = row;
      std::swap(a[pivot], a[column]);
      for (size_t row = 0; row < 3; ++row) {
        if (row == column) continue;
        const double factor = a[row][column] / a[column][column];
        for (size_t j = column; j < 4; ++j) a[row][j] -= factor * a[column][j];
      }
    }
    for (size_t i = 0; i < 3; ++i) c[i] += a[i][3] / a[i][i];
    return c;
  }

  std::array<Coefficients, kWavelengths> weights_;
  std::array<double, kWavelengths> t_;
};

}  // namespace etendue
