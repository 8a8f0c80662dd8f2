#include "spectrum/blackbody.h"

#include <algorithm>
#include <array>

namespace etendue {
namespace {

constexpr double kFirstWavelength = 380, kStep = 10;  // nm

// The colour matching functions x, y and z of the CIE 1931 standard observer [CIE 1931], every 10 nm.
constexpr double kObserver[][3] = {
    {0.0014, 0.0000, 0.0065}, {0.0042, 0.0001, 0.0201}, {0.0143, 0.0004, 0.0679}, {0.0435, 0.0012, 0.2074},
    {0.1344, 0.0040, 0.6456}, {0.2839, 0.0116, 1.3856}, {0.3483, 0.0230, 1.7471}, {0.3362, 0.0380, 1.7721},
    {0.2908, 0.0600, 1.6692}, {0.1954, 0.0910, 1.2876}, {0.0956, 0.1390, 0.8130}, {0.0320, 0.2080, 0.4652},
    {0.0049, 0.3230, 0.2720}, {0.0093, 0.5030, 0.1582}, {0.0633, 0.7100, 0.0782}, {0.1655, 0.8620, 0.0422},
    {0.2904, 0.9540, 0.0203}, {0.4334, 0.9950, 0.0087}, {0.5945, 0.9950, 0.0039}, {0.7621, 0.9520, 0.0021},
    {0.9163, 0.8700, 0.0017}, {1.0263, 0.7570, 0.0011}, {1.0622, 0.6310, 0.0008}, {1.0026, 0.5030, 0.0003},
    {0.8544, 0.3810, 0.0002}, {0.6424, 0.2650, 0.0000}, {0.4479, 0.1750, 0.0000}, {0.2835, 0.1070, 0.0000},
    {0.1649, 0.0610, 0.0000}, {0.0874, 0.0320, 0.0000}, {0.0468, 0.0170, 0.0000}, {0.0227, 0.0082, 0.0000},
    {0.0114, 0.0041, 0.0000}, {0.0058, 0.0021, 0.0000}, {0.0029, 0.0010, 0.0000}, {0.0014, 0.0005, 0.0000},
    {0.0007, 0.0003, 0.0000}, {0.0003, 0.0001, 0.0000}, {0.0002, 0.0001, 0.0000}, {0.0001, 0.0000, 0.0000},
    {0.0000, 0.0000, 0.0000},
};

constexpr double kSecondRadiationConstant = 1.438777e7;  // h c / k, nm K (CODATA 2018)

// XYZ to linear Rec. 709 [IEC 61966-2-1].
constexpr double kRec709[3][3] = {
    {3.2404542, -1.5371385, -0.4985314}, {-0.9692660, 1.8760108, 0.0415560}, {0.0556434, -0.2040259, 1.0572252}};

Rgb with_largest_component_one(const Rgb& color) {
  const float largest = max_component(color);
  return largest > 0 ? color / largest : Rgb(1);
}

// Planck's law up to a factor that does not depend on the wavelength.
double relative_radiance(double wavelength, double kelvin) {
  return std::pow(wavelength / 560, -5) / std::expm1(kSecondRadiationConstant / (wavelength * kelvin));
}

using Triplet = std::array<double, 3>;

Triplet xyz_of(const std::function<double(double)>& radiance) {
  Triplet xyz{};
  double wavelength = kFirstWavelength;
  for (const auto& observer : kObserver) {
    const double value = radiance(wavelength);
    for (size_t i = 0; i < 3; ++i) xyz[i] += value * observer[i];
    wavelength += kStep;
  }
  return xyz;
}

// Components outside of the gamut are clipped.
Triplet rec709_of(const Triplet& xyz) {
  Triplet rgb{};
  for (size_t c = 0; c < 3; ++c) {
    for (size_t i = 0; i < 3; ++i) rgb[c] += kRec709[c][i] * xyz[i];
    rgb[c] = std::max(rgb[c], 0.0);
  }
  return rgb;
}

Rgb scaled(const Triplet& rgb, double scale) {
  return {static_cast<float>(rgb[0] * scale), static_cast<float>(rgb[1] * scale), static_cast<float>(rgb[2] * scale)};
}

}  // namespace

Rgb blackbody_color(double kelvin) {
  const Triplet rgb = rec709_of(xyz_of([&](double wavelength) { return relative_radiance(wavelength, kelvin); }));
  return scaled(rgb, 1 / *std::ranges::max_element(rgb));
}

Rgb filtered_blackbody_color(double kelvin, const std::function<double(double)>& transmittance) {
  const auto bare = [&](double wavelength) { return relative_radiance(wavelength, kelvin); };
  const Triplet filtered = xyz_of([&](double wavelength) { return bare(wavelength) * transmittance(wavelength); });
  return scaled(rec709_of(filtered), 1 / xyz_of(bare)[1]);
}

double nearest_temperature(const Rgb& color) {
  // Steps of 2 %, then of 0.02 % around the best.
  constexpr double kCoarse = 1.02, kFine = 1.0002;
  const Rgb wanted = with_largest_component_one(color);
  const auto distance = [&](double kelvin) {
    const Rgb difference = blackbody_color(kelvin) - wanted;
    return difference.r * difference.r + difference.g * difference.g + difference.b * difference.b;
  };
  double best = kMinTemperature;
  float least = distance(best);
  const auto search = [&](double first, double last, double factor) {
    for (double kelvin = first; kelvin <= last; kelvin *= factor)
      if (const float d = distance(kelvin); d < least) {
        least = d;
        best = kelvin;
      }
  };
  search(kMinTemperature, kMaxTemperature, kCoarse);
  search(std::max(kMinTemperature, best / kCoarse), std::min(kMaxTemperature, best * kCoarse), kFine);
  return best;
}

}  // namespace etendue
