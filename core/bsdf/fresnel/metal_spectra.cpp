#include "bsdf/fresnel/metal_spectra.h"

#include <algorithm>

#include "bsdf/fresnel/optical_constants.h"

namespace etendue {
namespace {

// clang-format off
constexpr MetalSpectrum::Sample kSilver[] = {
    {367.9f, 0.07f, 1.657f}, {381.5f, 0.05f, 1.864f}, {397.4f, 0.05f, 2.07f}, {413.3f, 0.05f, 2.275f},
    {430.5f, 0.04f, 2.462f}, {450.9f, 0.04f, 2.657f}, {471.4f, 0.05f, 2.869f}, {495.9f, 0.05f, 3.093f},
    {520.9f, 0.05f, 3.324f}, {548.6f, 0.06f, 3.586f}, {582.1f, 0.05f, 3.858f}, {616.8f, 0.06f, 4.152f},
    {659.5f, 0.05f, 4.483f}, {704.5f, 0.04f, 4.838f}, {756.0f, 0.03f, 5.242f}, {821.1f, 0.04f, 5.727f},
};
constexpr MetalSpectrum::Sample kAluminium[] = {
    {364.66f, 0.39877f, 4.3957f}, {413.28f, 0.52135f, 5.0008f}, {442.8f, 0.6079f, 5.3676f},
    {476.87f, 0.7278f, 5.7781f}, {516.6f, 0.8734f, 6.2418f}, {563.57f, 1.0728f, 6.7839f}, {619.93f, 1.366f, 7.4052f},
    {652.25f, 1.5724f, 7.7354f}, {688.81f, 1.8301f, 8.0601f}, {729.32f, 2.1606f, 8.3565f},
    {774.91f, 2.6154f, 8.4914f}, {794.78f, 2.7675f, 8.3866f}, {815.69f, 2.7668f, 8.2573f},
};
constexpr MetalSpectrum::Sample kGold[] = {
    {367.9f, 1.48f, 1.895f}, {381.5f, 1.46f, 1.933f}, {397.4f, 1.47f, 1.952f}, {413.3f, 1.46f, 1.958f},
    {430.5f, 1.45f, 1.948f}, {450.9f, 1.38f, 1.914f}, {471.4f, 1.31f, 1.849f}, {495.9f, 1.04f, 1.833f},
    {520.9f, 0.62f, 2.081f}, {548.6f, 0.43f, 2.455f}, {582.1f, 0.29f, 2.863f}, {616.8f, 0.21f, 3.272f},
    {659.5f, 0.14f, 3.697f}, {704.5f, 0.13f, 4.103f}, {756.0f, 0.14f, 4.542f}, {821.1f, 0.16f, 5.083f},
};
constexpr MetalSpectrum::Sample kCopper[] = {
    {367.9f, 1.36f, 1.975f}, {381.5f, 1.33f, 2.045f}, {397.4f, 1.32f, 2.116f}, {413.3f, 1.28f, 2.207f},
    {430.5f, 1.25f, 2.305f}, {450.9f, 1.24f, 2.397f}, {471.4f, 1.25f, 2.483f}, {495.9f, 1.22f, 2.564f},
    {520.9f, 1.18f, 2.608f}, {548.6f, 1.02f, 2.577f}, {582.1f, 0.7f, 2.704f}, {616.8f, 0.3f, 3.205f},
    {659.5f, 0.22f, 3.747f}, {704.5f, 0.21f, 4.205f}, {756.0f, 0.24f, 4.665f}, {821.1f, 0.26f, 5.18f},
};
// clang-format on

constexpr MetalSpectrum kMetalSpectra[] = {{"silver-measured", kSilver},
                                           {"aluminium-measured", kAluminium},
                                           {"gold-measured", kGold},
                                           {"copper-measured", kCopper}};

// A metal with the constants of its preset.
struct MetalPreset {
  const MetalSpectrum* spectrum;
  Rgb eta, kappa;
};

const std::vector<MetalPreset>& metal_presets() {
  static const std::vector<MetalPreset> presets = [] {
    std::vector<MetalPreset> found;
    for (const MetalSpectrum& metal : kMetalSpectra)
      for (const ConductorConstants& c : kConductors)
        if (std::string_view(c.name) == metal.name)
          found.push_back({&metal, Rgb(c.eta.x, c.eta.y, c.eta.z), Rgb(c.kappa.x, c.kappa.y, c.kappa.z)});
    return found;
  }();
  return presets;
}

}  // namespace

float MetalSpectrum::interpolated(float wavelength, float Sample::*member) const {
  const auto after = std::ranges::upper_bound(samples, wavelength, {}, &Sample::wavelength);
  if (after == samples.begin()) return samples.front().*member;
  if (after == samples.end()) return samples.back().*member;
  const Sample &a = *(after - 1), &b = *after;
  const float t = (wavelength - a.wavelength) / (b.wavelength - a.wavelength);
  return a.*member * (1 - t) + b.*member * t;
}

std::span<const MetalSpectrum> metal_spectra() { return kMetalSpectra; }

const MetalSpectrum* find_metal_spectrum(const Rgb& eta, const Rgb& kappa) {
  for (const MetalPreset& preset : metal_presets())
    if (preset.eta == eta && preset.kappa == kappa) return preset.spectrum;
  return nullptr;
}

}  // namespace etendue
