#include "spectrum/wavelengths.h"

#include "spectrum/observer.h"

namespace etendue {
namespace {

// The distribution of the wavelengths by its quantiles: wavelength k has the cumulative probability k / kIntervals. The
// density is constant between two of them. The weights of the sRGB components over 4 p are tabulated every nanometre.
struct WavelengthTable {
  static constexpr size_t kIntervals = 1024, kNodes = 401;
  std::array<float, kIntervals + 1> quantiles;
  std::array<Rgb, kNodes> weights;

  WavelengthTable() {
    std::array<double, kNodes> cumulative{};
    const auto density = [](double wavelength) {
      double sum = 0;
      for (const double w : relative_rgb_weights(wavelength)) sum += std::abs(w);
      return sum;
    };
    for (size_t i = 0; i + 1 < kNodes; ++i) {
      const double wavelength = kFirstWavelength + static_cast<double>(i);
      cumulative[i + 1] = cumulative[i] + 0.5 * (density(wavelength) + density(wavelength + 1));
    }
    size_t node = 0;
    for (size_t k = 0; k <= kIntervals; ++k) {
      const double wanted = cumulative.back() * static_cast<double>(k) / kIntervals;
      while (node + 2 < kNodes && cumulative[node + 1] < wanted) ++node;
      const double t = (wanted - cumulative[node]) / (cumulative[node + 1] - cumulative[node]);
      quantiles[k] = static_cast<float>(kFirstWavelength + static_cast<double>(node) + std::clamp(t, 0.0, 1.0));
    }
    for (size_t i = 0; i < kNodes; ++i) {
      const auto w = relative_rgb_weights(kFirstWavelength + static_cast<double>(i));
      weights[i] = Rgb(static_cast<float>(w[0]), static_cast<float>(w[1]), static_cast<float>(w[2])) *
                   (1.0f / SampledSpectrum::kSize);
    }
  }

  // The interval of the quantiles that contains a wavelength.
  size_t interval_of(float wavelength) const {
    const auto after = std::upper_bound(quantiles.begin() + 1, quantiles.end() - 1, wavelength);
    return static_cast<size_t>(after - quantiles.begin()) - 1;
  }
  float pdf(float wavelength) const {
    const size_t k = interval_of(wavelength);
    return 1 / (kIntervals * (quantiles[k + 1] - quantiles[k]));
  }
};

const WavelengthTable& wavelength_table() {
  static const WavelengthTable table;
  return table;
}

}  // namespace

Wavelengths sample_wavelengths(float random) {
  const WavelengthTable& table = wavelength_table();
  Wavelengths result;
  for (size_t i = 0; i < result.nm.size(); ++i) {
    float u = random + static_cast<float>(i) / SampledSpectrum::kSize;
    if (u >= 1) u -= 1;
    const float at = u * WavelengthTable::kIntervals;
    const size_t k = std::min(static_cast<size_t>(at), WavelengthTable::kIntervals - 1);
    const float width = table.quantiles[k + 1] - table.quantiles[k];
    result.nm[i] = table.quantiles[k] + (at - static_cast<float>(k)) * width;
    result.inverse_pdf[i] = WavelengthTable::kIntervals * width;
  }
  return result;
}

float wavelength_pdf(float wavelength) {
  if (!(wavelength >= static_cast<float>(kFirstWavelength) && wavelength <= static_cast<float>(kLastWavelength)))
    return 0;
  return wavelength_table().pdf(wavelength);
}

Rgb rgb_estimate(const SampledSpectrum& radiance, const Wavelengths& wavelengths) {
  const WavelengthTable& table = wavelength_table();
  Rgb sum(0);
  for (size_t i = 0; i < wavelengths.nm.size(); ++i) {
    const float wavelength = wavelengths.nm[i];
    const float at = std::clamp(wavelength - static_cast<float>(kFirstWavelength), 0.0f,
                                static_cast<float>(WavelengthTable::kNodes - 1));
    const size_t node = std::min(static_cast<size_t>(at), WavelengthTable::kNodes - 2);
    const float t = at - static_cast<float>(node);
    sum += mix(table.weights[node], table.weights[node + 1], t) * (radiance.values[i] * wavelengths.inverse_pdf[i]);
  }
  return sum;
}

}  // namespace etendue
