#include "bsdf/measured/harmonic_brdf.h"

#include <array>

#include "base/spherical_harmonics.h"

namespace etendue {
namespace {

constexpr int kMaxBands = HarmonicBrdf::kMaxBands;

Vec3 at_cosine(double cosine, double phi) {
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  return {static_cast<float>(sine * std::cos(phi)), static_cast<float>(sine * std::sin(phi)),
          static_cast<float>(cosine)};
}

// The number of l of one m with even l + m.
int even_count(int bands, int m) { return (bands - m + 1) / 2; }

}  // namespace

HarmonicBrdf::HarmonicBrdf(const std::function<Rgb(const Vec3&, const Vec3&)>& f, int bands)
    : bands_(std::clamp(bands, 1, kMaxBands)) {
  constexpr int kCosines = 48, kAzimuths = 128;  // azimuths over 180 degrees
  const GaussLegendre gauss(kCosines);
  // The Fourier coefficients of f in the azimuth, by m and both cosines.
  const auto n = static_cast<size_t>(kCosines);
  std::vector<std::array<double, 3>> fourier(static_cast<size_t>(bands_) * n * n);
  for (size_t o = 0; o < n; ++o)
    for (size_t i = 0; i <= o; ++i) {
      const Vec3 o_at_zero = at_cosine(gauss.x[o], 0), i_at_zero = at_cosine(gauss.x[i], 0);
      for (int k = 0; k < kAzimuths; ++k) {
        const double phi = M_PI * (k + 0.5) / kAzimuths;
        // The mean of both orders makes the result reciprocal.
        const Vec3 i_at_phi = at_cosine(gauss.x[i], phi), o_at_phi = at_cosine(gauss.x[o], phi);
        const Rgb value = 0.5f * (f(o_at_zero, i_at_phi) + f(i_at_zero, o_at_phi));
        for (int m = 0; m < bands_; ++m)
          for (size_t band = 0; band < 3; ++band)
            fourier[(static_cast<size_t>(m) * n + o) * n + i][band] +=
                double{value[static_cast<int>(band)]} * std::cos(m * phi) * (m == 0 ? 1.0 : 2.0) / kAzimuths;
      }
      if (i < o)
        for (size_t m = 0; m < static_cast<size_t>(bands_); ++m)
          fourier[(m * n + i) * n + o] = fourier[(m * n + o) * n + i];
    }
  std::vector<double> diagonals(n, std::sqrt(0.5));
  for (int m = 0; m < bands_; ++m) {
    std::vector<std::array<double, kMaxBands>> p(n);
    for (size_t k = 0; k < n; ++k) {
      if (m > 0) diagonals[k] = next_legendre_diagonal(m, std::sqrt(1 - sqr(gauss.x[k])), diagonals[k]);
      normalized_legendre(bands_, m, gauss.x[k], diagonals[k], p[k]);
    }
    for (int l = m; l < bands_; l += 2)
      for (int l2 = m; l2 < bands_; l2 += 2) {
        Rgb c(0);
        for (size_t band = 0; band < 3; ++band) {
          double sum = 0;
          for (size_t o = 0; o < n; ++o)
            for (size_t i = 0; i < n; ++i)
              sum += 4 * gauss.weight[o] * gauss.weight[i] * p[o][static_cast<size_t>(l)] *
                     p[i][static_cast<size_t>(l2)] * fourier[(static_cast<size_t>(m) * n + o) * n + i][band];
          c[static_cast<int>(band)] = static_cast<float>(sum);
        }
        coefficients_.push_back(c);
      }
  }
  double clamped = 0, remaining = 0;
  for (size_t o = 0; o < n; o += 2)
    for (size_t i = 0; i < n; i += 2)
      for (int k = 0; k < kAzimuths; k += 4) {
        const Rgb value = sum(at_cosine(gauss.x[o], 0), at_cosine(gauss.x[i], M_PI * (k + 0.5) / kAzimuths));
        const double weight = gauss.weight[o] * gauss.weight[i] * gauss.x[o] * gauss.x[i];
        for (int band = 0; band < 3; ++band)
          (value[band] < 0 ? clamped : remaining) += weight * std::abs(double{value[band]});
      }
  clamped_part_ = remaining > 0 ? static_cast<float>(clamped / remaining) : 0;
}

Rgb HarmonicBrdf::sum(const Vec3& o, const Vec3& i) const {
  const float sine_o = std::sqrt(sqr(o.x) + sqr(o.y)), sine_i = std::sqrt(sqr(i.x) + sqr(i.y));
  const float sines = sine_o * sine_i;
  const float cos_dphi = sines > 0 ? std::clamp((o.x * i.x + o.y * i.y) / sines, -1.0f, 1.0f) : 1;
  float cos_m = 1, previous_cos_m = cos_dphi;  // cos(m dphi) and cos((m - 1) dphi)
  float diagonal_o = std::sqrt(0.5f), diagonal_i = diagonal_o;
  std::array<float, kMaxBands> p_o{}, p_i{};
  Rgb total(0);
  const Rgb* c = coefficients_.data();
  for (int m = 0; m < bands_; ++m) {
    if (m > 0) {
      diagonal_o = next_legendre_diagonal(m, sine_o, diagonal_o);
      diagonal_i = next_legendre_diagonal(m, sine_i, diagonal_i);
      const float next = 2 * cos_dphi * cos_m - previous_cos_m;
      previous_cos_m = cos_m;
      cos_m = next;
    }
    normalized_legendre(bands_, m, o.z, diagonal_o, p_o);
    normalized_legendre(bands_, m, i.z, diagonal_i, p_i);
    const int count = even_count(bands_, m);
    Rgb part(0);
    for (int l = 0; l < count; ++l) {
      Rgb row(0);
      for (int l2 = 0; l2 < count; ++l2) row += *c++ * p_i[static_cast<size_t>(m + 2 * l2)];
      part += row * p_o[static_cast<size_t>(m + 2 * l)];
    }
    total += part * cos_m;
  }
  return total;
}

Rgb HarmonicBrdf::f(const Vec3& o, const Vec3& i) const {
  const Rgb value = sum(o, i);
  return {std::max(value.r, 0.0f), std::max(value.g, 0.0f), std::max(value.b, 0.0f)};
}

}  // namespace etendue
