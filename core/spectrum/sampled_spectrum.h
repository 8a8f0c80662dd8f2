// A spectral quantity at the four wavelengths of a path.                                            [Wilkie et al. 2014]
//
// The colour type of the spectral transport model; its interface is that of Rgb (rgb.h). Component 0 belongs to the
// hero wavelength.
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace etendue {

struct SampledSpectrum {
  static constexpr int kSize = 4;
  std::array<float, kSize> values{};

  constexpr SampledSpectrum() = default;
  constexpr explicit SampledSpectrum(float constant) { values.fill(constant); }

  constexpr float& operator[](int i) { return values[static_cast<size_t>(i)]; }
  constexpr float operator[](int i) const { return values[static_cast<size_t>(i)]; }

  constexpr SampledSpectrum& operator+=(const SampledSpectrum& o) {
    for (int i = 0; i < kSize; ++i) (*this)[i] += o[i];
    return *this;
  }
  constexpr SampledSpectrum& operator-=(const SampledSpectrum& o) {
    for (int i = 0; i < kSize; ++i) (*this)[i] -= o[i];
    return *this;
  }
  constexpr SampledSpectrum& operator*=(const SampledSpectrum& o) {
    for (int i = 0; i < kSize; ++i) (*this)[i] *= o[i];
    return *this;
  }
  constexpr SampledSpectrum& operator*=(float s) {
    for (float& v : values) v *= s;
    return *this;
  }
  constexpr SampledSpectrum& operator/=(float s) { return *this *= 1 / s; }

  friend constexpr SampledSpectrum operator+(SampledSpectrum a, const SampledSpectrum& b) { return a += b; }
  friend constexpr SampledSpectrum operator-(SampledSpectrum a, const SampledSpectrum& b) { return a -= b; }
  friend constexpr SampledSpectrum operator*(SampledSpectrum a, const SampledSpectrum& b) { return a *= b; }
  friend constexpr SampledSpectrum operator*(SampledSpectrum a, float s) { return a *= s; }
  friend constexpr SampledSpectrum operator*(float s, SampledSpectrum a) { return a *= s; }
  friend constexpr SampledSpectrum operator/(SampledSpectrum a, float s) { return a /= s; }
  friend constexpr bool operator==(const SampledSpectrum&, const SampledSpectrum&) = default;
};

constexpr float max_component(const SampledSpectrum& s) { return std::max(std::max(s[0], s[1]), std::max(s[2], s[3])); }
// The mean over the wavelengths.
constexpr float average(const SampledSpectrum& s) { return 0.25f * (s[0] + s[1] + s[2] + s[3]); }
constexpr float luminance(const SampledSpectrum& s) { return average(s); }
// a / b by component; 0 for components where b is 0.
constexpr SampledSpectrum ratio(const SampledSpectrum& a, const SampledSpectrum& b) {
  SampledSpectrum quotient;
  for (int i = 0; i < SampledSpectrum::kSize; ++i) quotient[i] = b[i] == 0 ? 0 : a[i] / b[i];
  return quotient;
}
// True if all components are zero.
constexpr bool is_black(const SampledSpectrum& s) {
  uint32_t bits = 0;
  for (const float v : s.values) bits |= std::bit_cast<uint32_t>(v);
  return bits << 1 == 0;
}
inline bool is_finite(const SampledSpectrum& s) {
  return std::ranges::all_of(s.values, [](float v) { return std::isfinite(v); });
}

}  // namespace etendue
