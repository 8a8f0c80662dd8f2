#include "base/spherical_harmonics.h"

#include <algorithm>
#include <numbers>

namespace etendue {
namespace {

constexpr double kPiD = std::numbers::pi;

// p_lm(z) with the sign of Condon and Shortley, m >= 0.
double legendre(int l, int m, double z) {
  const double sine = std::sqrt(std::max(0.0, 1 - z * z));
  double diagonal = std::sqrt(0.5);
  for (int k = 1; k <= m; ++k) diagonal = next_legendre_diagonal(k, sine, diagonal);
  std::vector<double> p(static_cast<size_t>(l) + 1);
  normalized_legendre(l + 1, m, z, diagonal, p);
  return m % 2 == 0 ? p[static_cast<size_t>(l)] : -p[static_cast<size_t>(l)];
}

int bands_of(const HarmonicCoefficients& c) {
  return static_cast<int>(std::lround(std::sqrt(static_cast<double>(c.size()))));
}

HarmonicDirection direction_at(double z, double phi) {
  const double sine = std::sqrt(std::max(0.0, 1 - z * z));
  return {sine * std::cos(phi), sine * std::sin(phi), z};
}

}  // namespace

GaussLegendre::GaussLegendre(int n) {
  // The nodes are roots of the Legendre polynomial, found by Newton's method.
  for (int k = 0; k < n; ++k) {
    double z = std::cos(kPiD * (k + 0.75) / (n + 0.5)), slope = 1;
    for (int step = 0; step < 50; ++step) {
      double p0 = 1, p1 = z;
      for (int l = 2; l <= n; ++l) {
        const double p2 = ((2 * l - 1) * z * p1 - (l - 1) * p0) / l;
        p0 = p1;
        p1 = p2;
      }
      slope = n * (z * p1 - p0) / (z * z - 1);
      const double move = p1 / slope;
      z -= move;
      if (std::abs(move) < 1e-15) break;
    }
    x.push_back(0.5 * (1 + z));
    weight.push_back(1 / ((1 - z * z) * slope * slope));
  }
}

double real_harmonic(int l, int m, const HarmonicDirection& direction) {
  const double p = legendre(l, std::abs(m), direction.z);
  if (m == 0) return p / std::sqrt(2 * kPiD);
  const double phi = std::atan2(direction.y, direction.x);
  return p / std::sqrt(kPiD) * (m > 0 ? std::cos(m * phi) : std::sin(-m * phi));
}

std::complex<double> complex_harmonic(int l, int m, const HarmonicDirection& direction) {
  const double phi = std::atan2(direction.y, direction.x);
  // Y_l,-m is (-1)^m times the conjugate of Y_lm.
  const double sign = m < 0 && m % 2 != 0 ? -1 : 1;
  return std::polar(1.0, m * phi) * (sign * legendre(l, std::abs(m), direction.z) / std::sqrt(2 * kPiD));
}

HarmonicCoefficients real_harmonics(int bands, const HarmonicDirection& direction) {
  HarmonicCoefficients y(harmonic_count(bands));
  const double sine = std::sqrt(direction.x * direction.x + direction.y * direction.y);
  const std::complex<double> turn = sine > 0 ? std::complex(direction.x, direction.y) / sine : std::complex<double>(1);
  std::complex<double> azimuth(1);  // e^(i m phi), with the sign (-1)^m
  std::vector<double> p(static_cast<size_t>(bands));
  double diagonal = std::sqrt(0.5);
  for (int m = 0; m < bands; ++m) {
    if (m > 0) {
      diagonal = next_legendre_diagonal(m, sine, diagonal);
      azimuth *= -turn;
    }
    normalized_legendre(bands, m, direction.z, diagonal, p);
    const double scale = 1 / std::sqrt(m == 0 ? 2 * kPiD : kPiD);
    for (int l = m; l < bands; ++l) {
      y[harmonic_index(l, m)] = scale * p[static_cast<size_t>(l)] * azimuth.real();
      if (m > 0) y[harmonic_index(l, -m)] = scale * p[static_cast<size_t>(l)] * azimuth.imag();
    }
  }
  return y;
}

HarmonicCoefficients project_on_harmonics(const std::function<double(const HarmonicDirection&)>& f, int bands,
                                          int nodes) {
  HarmonicCoefficients c(harmonic_count(bands), 0.0);
  const GaussLegendre rule(nodes);
  const int azimuths = 2 * nodes;
  for (int k = 0; k < nodes; ++k)
    for (const double side : {1.0, -1.0})
      for (int j = 0; j < azimuths; ++j) {
        const auto node = static_cast<size_t>(k);
        const HarmonicDirection direction = direction_at(side * rule.x[node], 2 * kPiD * (j + 0.5) / azimuths);
        const double value = f(direction) * rule.weight[node] * 2 * kPiD / azimuths;
        const HarmonicCoefficients y = real_harmonics(bands, direction);
        for (size_t i = 0; i < c.size(); ++i) c[i] += value * y[i];
      }
  return c;
}

double evaluate_harmonics(const HarmonicCoefficients& c, const HarmonicDirection& direction) {
  return harmonic_product(c, real_harmonics(bands_of(c), direction));
}

double harmonic_product(const HarmonicCoefficients& a, const HarmonicCoefficients& b) {
  double sum = 0;
  for (size_t i = 0; i < std::min(a.size(), b.size()); ++i) sum += a[i] * b[i];
  return sum;
}

// Rotation mixes the harmonics of a band only, and the rotated function has the same number of bands, so the quadrature
// is exact.
HarmonicCoefficients rotate_harmonics(const HarmonicCoefficients& c, const glm::dmat3& rotation) {
  const glm::dmat3 inverse = glm::transpose(rotation);
  const int bands = bands_of(c);
  return project_on_harmonics([&](const HarmonicDirection& w) { return evaluate_harmonics(c, inverse * w); }, bands,
                              2 * bands + 2);
}

double clamped_cosine_coefficient(int l) {
  if (l == 0) return std::sqrt(kPiD) / 2;
  if (l == 1) return std::sqrt(kPiD / 3);
  if (l % 2 == 1) return 0;
  // (-1)^(l/2 - 1) / ((l + 2) (l - 1)) * l! / (2^l ((l/2)!)^2)
  double ratio = 1;
  for (int k = 1; k <= l / 2; ++k) ratio *= (2.0 * k - 1) / (2.0 * k);
  const double sign = l / 2 % 2 == 1 ? 1 : -1;
  return 2 * kPiD * std::sqrt((2 * l + 1) / (4 * kPiD)) * sign / ((l + 2.0) * (l - 1.0)) * ratio;
}

HarmonicCoefficients convolve_harmonics(const HarmonicCoefficients& c, const std::vector<double>& zonal) {
  HarmonicCoefficients result(c.size(), 0.0);
  for (int l = 0; l < bands_of(c) && l < static_cast<int>(zonal.size()); ++l)
    for (int m = -l; m <= l; ++m)
      result[harmonic_index(l, m)] =
          std::sqrt(4 * kPiD / (2 * l + 1)) * zonal[static_cast<size_t>(l)] * c[harmonic_index(l, m)];
  return result;
}

}  // namespace etendue
