#include "spectrum/blackbody.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "spectrum/observer.h"

namespace etendue {
namespace {

constexpr double kSecondRadiationConstant = 1.438777e7;  // h c / k, nm K (CODATA 2018)

Rgb with_largest_component_one(const Rgb& color) {
  const float largest = max_component(color);
  return largest > 0 ? color / largest : Rgb(1);
}

// Components outside of the gamut are clipped.
Rgb clipped(const std::array<double, 3>& rgb, double scale) {
  const auto component = [&](double v) { return static_cast<float>(std::max(v, 0.0) * scale); };
  return {component(rgb[0]), component(rgb[1]), component(rgb[2])};
}

}  // namespace

double blackbody_at(double wavelength, double kelvin) {
  constexpr double kReference = 560;  // nm
  const auto planck = [&](double nm) {
    return std::pow(nm / kReference, -5) / std::expm1(kSecondRadiationConstant / (nm * kelvin));
  };
  return planck(wavelength) / planck(kReference);
}

Rgb blackbody_color(double kelvin) {
  const auto rgb = rgb_of(xyz_of([&](double wavelength) { return blackbody_at(wavelength, kelvin); }));
  return with_largest_component_one(clipped(rgb, 1));
}

Rgb filtered_blackbody_color(double kelvin, const std::function<double(double)>& transmittance) {
  const auto bare = [&](double wavelength) { return blackbody_at(wavelength, kelvin); };
  const auto filtered = [&](double wavelength) { return bare(wavelength) * transmittance(wavelength); };
  return clipped(rgb_of(xyz_of(filtered)), 1 / xyz_of(bare).y);
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
