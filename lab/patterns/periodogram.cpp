#include "patterns/periodogram.h"

#include <cmath>
#include <complex>
#include <numbers>

namespace etendue::patterns {
namespace {

using Complex = std::complex<double>;

// exp(-2 pi i k x) for k = 0, ..., extent. Rounding errors grow with k and stay below 1e-12.
std::vector<Complex> powers(double x, int extent) {
  const Complex step = std::polar(1.0, -2 * std::numbers::pi * x);
  std::vector<Complex> all{1};
  for (int k = 1; k <= extent; ++k) all.push_back(all.back() * step);
  return all;
}

Complex at_frequency(const std::vector<Complex>& powers, int k) {
  const Complex& power = powers[static_cast<size_t>(std::abs(k))];
  return k < 0 ? std::conj(power) : power;
}

}  // namespace

Periodogram periodogram(const PointSet& points, int extent) {
  const auto side = static_cast<size_t>(2 * extent + 1);
  std::vector<Complex> sums(side * side);
  for (const PlanePoint& p : points) {
    const auto x = powers(p[0], extent), y = powers(p[1], extent);
    size_t i = 0;
    for (int ky = -extent; ky <= extent; ++ky)
      for (int kx = -extent; kx <= extent; ++kx) sums[i++] += at_frequency(x, kx) * at_frequency(y, ky);
  }
  Periodogram result{.extent = extent, .power = {}};
  for (const Complex& sum : sums) result.power.push_back(std::norm(sum) / static_cast<double>(points.size()));
  return result;
}

Periodogram mean_periodogram(const std::vector<PointSet>& sets, int extent) {
  Periodogram mean = periodogram(sets.front(), extent);
  for (size_t i = 1; i < sets.size(); ++i) {
    const Periodogram next = periodogram(sets[i], extent);
    for (size_t k = 0; k < mean.power.size(); ++k) mean.power[k] += next.power[k];
  }
  for (double& power : mean.power) power /= static_cast<double>(sets.size());
  return mean;
}

RadialSpectrum radial_spectrum(const Periodogram& spectrum) {
  const auto rings = static_cast<size_t>(spectrum.extent);
  std::vector<double> count(rings), sum(rings), squares(rings);
  for (int ky = -spectrum.extent; ky <= spectrum.extent; ++ky)
    for (int kx = -spectrum.extent; kx <= spectrum.extent; ++kx) {
      const auto ring = static_cast<int>(std::floor(std::hypot(kx, ky) + 0.5));
      if (ring < 1 || ring > spectrum.extent) continue;
      const auto r = static_cast<size_t>(ring - 1);
      const double power = spectrum.at(kx, ky);
      ++count[r];
      sum[r] += power;
      squares[r] += power * power;
    }
  RadialSpectrum radial;
  for (size_t r = 0; r < rings; ++r) {
    const double mean = sum[r] / count[r], variance = squares[r] / count[r] - mean * mean;
    radial.mean.push_back(mean);
    radial.anisotropy.push_back(mean > 0 ? std::max(variance, 0.0) / (mean * mean) : 0);
  }
  return radial;
}

}  // namespace etendue::patterns
