#include "medium/blackbody_table.h"

#include <algorithm>
#include <cmath>

#include "spectrum/blackbody.h"
#include "spectrum/observer.h"

namespace etendue {
namespace {

constexpr size_t kEntries = 256;

// The luminance of a black body relative to D65, in the scale of blackbody_at.
double luminance_of_blackbody(double kelvin) {
  const auto rgb = relative_rgb_of([&](double nm) { return blackbody_at(nm, kelvin) / d65_at(nm); });
  return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

}  // namespace

BlackbodyTable::BlackbodyTable(float highest) : highest_(highest) {
  const float brightest = luminance(blackbody_color(kelvin(1)));
  for (size_t i = 0; i < kEntries; ++i) {
    const double relative = static_cast<double>(i) / (kEntries - 1);
    const double temperature = kelvin(relative);
    const Rgb rgb = blackbody_color(temperature) * static_cast<float>(std::pow(relative, 4)) / brightest;
    entries_.push_back({rgb, static_cast<float>(double{luminance(rgb)} / luminance_of_blackbody(temperature))});
  }
}

double BlackbodyTable::kelvin(double relative) const {
  return std::clamp(relative * static_cast<double>(highest_), kMinTemperature, kMaxTemperature);
}

BlackbodyTable::Position BlackbodyTable::position(float relative) const {
  const float at = std::clamp(relative, 0.0f, 1.0f) * static_cast<float>(kEntries - 1);
  const size_t entry = std::min(static_cast<size_t>(at), kEntries - 2);
  return {entry, at - static_cast<float>(entry)};
}

Rgb BlackbodyTable::at(float relative) const {
  const auto [i, t] = position(relative);
  return entries_[i].rgb * (1 - t) + entries_[i + 1].rgb * t;
}

SampledSpectrum BlackbodyTable::at(float relative, const Wavelengths& wavelengths) const {
  const auto [i, t] = position(relative);
  const float scale = entries_[i].scale * (1 - t) + entries_[i + 1].scale * t;
  const double temperature = kelvin(static_cast<double>(relative));
  SampledSpectrum result;
  for (size_t k = 0; k < wavelengths.nm.size(); ++k) {
    const auto nm = static_cast<double>(wavelengths.nm[k]);
    result.values[k] = scale * static_cast<float>(blackbody_at(nm, temperature) / d65_at(nm));
  }
  return result;
}

}  // namespace etendue
