#include "spectrum/uplift.h"

#include <array>
#include <cstdint>
#include <vector>

#include "spectrum/observer.h"

namespace etendue {
namespace {

using Coefficients = std::array<double, 3>;

double normalized(double wavelength) { return (wavelength - kFirstWavelength) / (kLastWavelength - kFirstWavelength); }

constexpr float kSigmoidStart = static_cast<float>(kFirstWavelength),
                kInverseSigmoidRange = static_cast<float>(1 / (kLastWavelength - kFirstWavelength));

double sigmoid(double p) { return 0.5 + 0.5 * p / std::sqrt(1 + p * p); }
double sigmoid_derivative(double p) { return 0.5 / ((1 + p * p) * std::sqrt(1 + p * p)); }

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

// Coefficients by the index of the largest component, its value, and the ratios of the two others to it.
class UpliftTable {
 public:
  UpliftTable() : nodes_(3 * kScales * kRatios * kRatios) {
    for (size_t z = 0; z < kScales; ++z)
      scales_[z] = static_cast<float>(smooth(smooth(static_cast<double>(z) / (kScales - 1))));
    for (size_t k = 0; k < kGuesses; ++k)
      guesses_[k] = static_cast<uint8_t>(interval_of(static_cast<float>(k) / (kGuesses - 1), 0));
    const SigmoidFit fit;
    for (size_t largest = 0; largest < 3; ++largest)
      for (size_t y = 0; y < kRatios; ++y)
        for (size_t x = 0; x < kRatios; ++x) fill_column(fit, largest, y, x);
  }

  SigmoidSpectrum at(const Rgb& color) const {
    const int largest = color.r >= color.g && color.r >= color.b ? 0 : color.g >= color.b ? 1 : 2;
    const float scale = color[largest];
    if (!(scale > 0)) return {0, 0, kBlack};
    const float to_node = (kRatios - 1) / scale;
    const float x = color[(largest + 1) % 3] * to_node, y = color[(largest + 2) % 3] * to_node;
    const size_t xi = std::min(static_cast<size_t>(x), kRatios - 2), yi = std::min(static_cast<size_t>(y), kRatios - 2),
                 zi = interval_of(scale, guesses_[static_cast<size_t>(scale * (kGuesses - 1))]);
    const float fx = x - static_cast<float>(xi), fy = y - static_cast<float>(yi),
                fz = (scale - scales_[zi]) / (scales_[zi + 1] - scales_[zi]);
    Node sum{};
    const auto add_row = [&](size_t dy, size_t dz, float weight) {
      const Node* row = &nodes_[index(static_cast<size_t>(largest), zi + dz, yi + dy, xi)];
      const float left = weight * (1 - fx), right = weight * fx;
      for (size_t k = 0; k < sum.size(); ++k) sum[k] += left * row[0][k] + right * row[1][k];
    };
    add_row(0, 0, (1 - fy) * (1 - fz));
    add_row(1, 0, fy * (1 - fz));
    add_row(0, 1, (1 - fy) * fz);
    add_row(1, 1, fy * fz);
    return {sum[0], sum[1], sum[2]};
  }

 private:
  using Node = std::array<float, 4>;  // c0, c1, c2 and padding
  static constexpr size_t kScales = 32, kRatios = 32, kGuesses = 1025;
  static constexpr float kBlack = -2000;  // S < 1e-7

  static size_t index(size_t largest, size_t z, size_t y, size_t x) {
    return ((largest * kScales + z) * kRatios + y) * kRatios + x;
  }
  // The interval of the values of the largest component that contains `scale`, which is not before `guess`.
  size_t interval_of(float scale, size_t guess) const {
    while (guess + 2 < kScales && scales_[guess + 1] <= scale) ++guess;
    return guess;
  }

  // The values of the largest component are denser near 0 and 1, where the coefficients vary most.
  static double smooth(double x) { return x * x * (3 - 2 * x); }

  // All values of the largest component, from the middle towards dark and bright, each from the solution before.
  void fill_column(const SigmoidFit& fit, size_t largest, size_t y, size_t x) {
    Coefficients c{};
    fill(fit, largest, kScales / 2, y, x, c);
    const Coefficients middle = c;
    for (size_t z = kScales / 2 + 1; z < kScales; ++z) fill(fit, largest, z, y, x, c);
    c = middle;
    for (size_t z = kScales / 2; z-- > 0;) fill(fit, largest, z, y, x, c);
  }
  void fill(const SigmoidFit& fit, size_t largest, size_t z, size_t y, size_t x, Coefficients& c) {
    constexpr double kDarkest = 1e-6;
    const double scale = std::max(double{scales_[z]}, kDarkest);
    Coefficients color{};
    color[largest] = scale;
    color[(largest + 1) % 3] = scale * static_cast<double>(x) / (kRatios - 1);
    color[(largest + 2) % 3] = scale * static_cast<double>(y) / (kRatios - 1);
    fit.fit(color, c);
    nodes_[index(largest, z, y, x)] = {static_cast<float>(c[0]), static_cast<float>(c[1]), static_cast<float>(c[2]), 0};
  }

  std::vector<Node> nodes_;
  std::array<float, kScales> scales_{};
  std::array<uint8_t, kGuesses> guesses_{};  // intervals of equidistant values
};

const UpliftTable& uplift_table() {
  static const UpliftTable table;
  return table;
}

bool is_grey(const Rgb& c) { return c.r == c.g && c.g == c.b; }

// A loop over the wavelengths that compilers vectorize.
SampledSpectrum sampled(const SigmoidSpectrum& spectrum, const Wavelengths& wavelengths) {
  SampledSpectrum result;
  for (size_t i = 0; i < result.values.size(); ++i) {
    const float t = (wavelengths.nm[i] - kSigmoidStart) * kInverseSigmoidRange;
    const float p = (spectrum.c0 * t + spectrum.c1) * t + spectrum.c2;
    result.values[i] = 0.5f + 0.5f * p / std::sqrt(1 + p * p);
  }
  return result;
}

}  // namespace

SigmoidSpectrum SigmoidSpectrum::of(const Rgb& color) { return uplift_table().at(color); }

float SigmoidSpectrum::operator()(float wavelength) const {
  const float t = (wavelength - kSigmoidStart) * kInverseSigmoidRange, p = (c0 * t + c1) * t + c2;
  return 0.5f + 0.5f * p / std::sqrt(1 + p * p);
}

SampledSpectrum uplift_reflectance(const Rgb& color, const Wavelengths& wavelengths) {
  const auto unit = [](float x) { return x > 0 ? std::min(x, 1.0f) : 0.0f; };  // NaN becomes 0
  const Rgb c(unit(color.r), unit(color.g), unit(color.b));
  if (is_grey(c)) return SampledSpectrum(c.r);
  return sampled(uplift_table().at(c), wavelengths);
}

SampledSpectrum uplift_scaled(const Rgb& color, const Wavelengths& wavelengths) {
  if (is_grey(color)) return SampledSpectrum(color.r);
  const float largest = max_component(color);
  if (!(largest > 0)) return SampledSpectrum(0);
  return uplift_reflectance(color / largest, wavelengths) * largest;
}

SampledSpectrum uplift_emission(const Rgb& color, const Wavelengths& wavelengths) {
  if (is_grey(color)) return SampledSpectrum(color.r);
  const float scale = 2 * max_component(color);
  if (!(scale > 0)) return SampledSpectrum(0);
  return uplift_reflectance(color / scale, wavelengths) * scale;
}

}  // namespace etendue
