#include "light/environments/sun.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "spectrum/blackbody.h"

namespace etendue {
namespace {

constexpr double kSunTemperature = 5778;    // K
constexpr double kSunIlluminance = 128000;  // lx above the atmosphere

// The absorption coefficient of ozone every 20 nm from 380 nm, 1/cm [Leckner 1978].
constexpr double kOzone[] = {0,     0,     0,     0.003, 0.006, 0.014, 0.030, 0.048, 0.075, 0.103, 0.120,
                             0.125, 0.105, 0.079, 0.057, 0.036, 0.023, 0.014, 0.010, 0.008, 0.007};

double ozone_absorption(double wavelength) {
  const double at = std::clamp((wavelength - 380) / 20, 0.0, static_cast<double>(std::size(kOzone) - 1) - 1e-9);
  const auto i = static_cast<size_t>(at);
  return kOzone[i] + (at - static_cast<double>(i)) * (kOzone[i + 1] - kOzone[i]);
}

// Of a path through the whole atmosphere; the wavelength in nm.
double transmittance(double wavelength, double air_mass, double turbidity) {
  constexpr double kOzoneThickness = 0.35;  // cm
  const double micrometres = wavelength / 1000;
  const double rayleigh = 0.008735 * std::pow(micrometres, -4.08);
  const double aerosol = std::max(0.04608 * turbidity - 0.04586, 0.0) * std::pow(micrometres, -1.3);
  return std::exp(-air_mass * (rayleigh + aerosol + kOzoneThickness * ozone_absorption(wavelength)));
}

// Relative to the zenith [Kasten 1966].
double air_mass_of(double elevation) {
  return 1 / (std::sin(elevation) + 0.15 * std::pow(elevation * 180 / M_PI + 3.885, -1.253));
}

// Of the sun from the equator, radians [Cooper 1969].
double declination_of(int day) { return 23.45 * M_PI / 180 * std::sin(2 * M_PI * (284 + day) / 365); }

}  // namespace

float solid_angle_of_sun() { return 4 * kPi * sqr(std::sin(0.5f * kSunAngularRadius)); }

SunAngles sun_angles(const Sky& sky) {
  if (sky.sun_position == SunPosition::angles)
    return {.elevation = sky.sun_elevation, .azimuth = sky.sun_azimuth, .is_up = true};
  const double latitude = sky.latitude, declination = declination_of(sky.day), angle = (sky.hour - 12) * M_PI / 12;
  const double sine =
      std::sin(latitude) * std::sin(declination) + std::cos(latitude) * std::cos(declination) * std::cos(angle);
  const double east = -std::cos(declination) * std::sin(angle);
  const double north =
      std::sin(declination) * std::cos(latitude) - std::cos(declination) * std::sin(latitude) * std::cos(angle);
  return {.elevation = static_cast<float>(std::asin(std::clamp(sine, 0.0, 1.0))),
          .azimuth = static_cast<float>(std::atan2(east, -north)),
          .is_up = sine >= 0};
}

Vec3 sun_direction(const Sky& sky) {
  const SunAngles sun = sun_angles(sky);
  const float across = std::cos(sun.elevation);
  return {std::sin(sun.azimuth) * across, std::sin(sun.elevation), std::cos(sun.azimuth) * across};
}

Rgb sun_radiance(const Sky& sky) {
  const SunAngles sun = sun_angles(sky);
  if (!sun.is_up) return Rgb(0);
  const double air_mass = air_mass_of(std::max(static_cast<double>(sun.elevation), 0.0));
  const Rgb color = filtered_blackbody_color(kSunTemperature, [&](double wavelength) {
    return transmittance(wavelength, air_mass, static_cast<double>(sky.turbidity));
  });
  return color * (static_cast<float>(kSunIlluminance) / solid_angle_of_sun());
}

}  // namespace etendue
