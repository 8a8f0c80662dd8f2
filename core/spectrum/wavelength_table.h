// Values at the whole nanometres of the visible range, linear in between.
#pragma once
#include <algorithm>
#include <array>

#include "spectrum/observer.h"
#include "spectrum/wavelengths.h"

namespace etendue {

class WavelengthTable {
 public:
  static constexpr size_t kNodes = static_cast<size_t>(kLastWavelength - kFirstWavelength) + 1;

  static constexpr double wavelength(size_t node) { return kFirstWavelength + static_cast<double>(node); }

  // The linear sRGB value of a spectrum relative to D65 with these values at the nodes, by the trapezoidal rule.
  // Components outside the gamut are negative.
  static std::array<double, 3> rgb_of(const std::array<double, kNodes>& values) {
    std::array<double, 3> sum{};
    for (size_t i = 0; i < kNodes; ++i) {
      const auto weights = relative_rgb_weights(wavelength(i));
      const double width = i == 0 || i + 1 == kNodes ? 0.5 : 1;
      for (size_t c = 0; c < 3; ++c) sum[c] += width * values[i] * weights[c];
    }
    return sum;
  }

  float& operator[](size_t node) { return values_[node]; }
  float operator[](size_t node) const { return values_[node]; }

  // In nm; wavelengths outside of the table have the value at the closer end.
  float at(float wavelength) const {
    const float x = std::clamp(wavelength - static_cast<float>(kFirstWavelength), 0.0f, static_cast<float>(kNodes - 1));
    const size_t node = std::min(static_cast<size_t>(x), kNodes - 2);
    const float t = x - static_cast<float>(node);
    return values_[node] * (1 - t) + values_[node + 1] * t;
  }
  SampledSpectrum at(const Wavelengths& wavelengths) const {
    SampledSpectrum result;
    for (size_t i = 0; i < wavelengths.nm.size(); ++i) result.values[i] = at(wavelengths.nm[i]);
    return result;
  }

 private:
  std::array<float, kNodes> values_{};
};

}  // namespace etendue
