#include "medium/medium_presets.h"

namespace etendue {
namespace {

constexpr float kPerMillimetre = 1000;  // 1/mm in 1/m

PhaseFunctionRef henyey_greenstein(float g) { return {make_phase_function("henyey-greenstein")->with("g", double{g})}; }

// Reduced scattering coefficients, which stand for isotropic scattering.
MediumPreset jensen(const char* name, const char* label, const Rgb& reduced_scattering, const Rgb& absorption) {
  return {name,
          label,
          "[Jensen et al. 2001], table 1: reduced scattering, hence an isotropic phase function",
          {reduced_scattering * kPerMillimetre, absorption * kPerMillimetre, {}}};
}

// `g` is the mean over the three channels.
MediumPreset narasimhan(const char* name, const char* label, const Rgb& scattering, const Rgb& absorption, float g) {
  return {name,
          label,
          "[Narasimhan et al. 2006], table 1; g is the mean over the channels",
          {scattering * kPerMillimetre, absorption * kPerMillimetre, henyey_greenstein(g)}};
}

// Measured at 514 nm, used for all channels.
MediumPreset petzold(const char* name, const char* label, float scattering, float absorption) {
  return {name,
          label,
          "[Petzold 1972], measured at 514 nm and used for all channels; g = 0.924 [Mobley 1994]",
          {Rgb(scattering), Rgb(absorption), henyey_greenstein(0.924f)}};
}

// Koschmieder: contrast falls to 2 % at the visual range.
MediumPreset fog(const char* name, const char* label, float visual_range, const char* source) {
  return {name, label, source, {Rgb(3.912f / visual_range), Rgb(0), {make_phase_function("mie-murky")}}};
}

}  // namespace

const std::vector<MediumPreset>& medium_presets() {
  static const std::vector<MediumPreset> all{
      fog("fog", "Fog (visual range 50 m)", 50, "[Koschmieder 1924]: extinction 3.912 / 50 m, no absorption"),
      fog("haze", "Haze (visual range 2 km)", 2000, "[Koschmieder 1924]: extinction 3.912 / 2 km, no absorption"),
      {"smoke",
       "Smoke of a flame (0.1 g/m^3)",
       "[Mulholland and Croarkin 2000]: specific extinction 8.7 m^2/g; albedo 0.2 and g = 0.6 of soot, rounded",
       {Rgb(0.174f), Rgb(0.696f), henyey_greenstein(0.6f)}},
      jensen("milk", "Whole milk", {2.55f, 3.21f, 3.77f}, {0.0011f, 0.0024f, 0.014f}),
      jensen("skim-milk", "Skim milk", {0.70f, 1.22f, 1.90f}, {0.0014f, 0.0025f, 0.0142f}),
      narasimhan("regular-milk", "Regular milk, anisotropic", {18.2052f, 20.3826f, 22.3698f},
                 {0.00153f, 0.0046f, 0.01993f}, 0.715f),
      jensen("cream", "Cream", {7.38f, 5.47f, 3.15f}, {0.0002f, 0.0028f, 0.0163f}),
      jensen("ketchup", "Ketchup", {0.18f, 0.07f, 0.03f}, {0.061f, 0.97f, 1.45f}),
      jensen("marble", "Marble", {2.19f, 2.62f, 3.00f}, {0.0021f, 0.0041f, 0.0071f}),
      jensen("skin-1", "Skin 1", {0.74f, 0.88f, 1.01f}, {0.032f, 0.17f, 0.48f}),
      jensen("skin-2", "Skin 2", {1.09f, 1.59f, 1.79f}, {0.013f, 0.070f, 0.145f}),
      jensen("spectralon", "Spectralon", {11.6f, 20.4f, 14.9f}, Rgb(0)),
      narasimhan("apple-juice", "Apple juice", {0.00257f, 0.00311f, 0.00413f}, {0.01296f, 0.02374f, 0.05218f}, 0.947f),
      narasimhan("ocean-surface", "Pacific ocean, surface water", {0.03184f, 0.03132f, 0.03015f},
                 {0.0018f, 0.00183f, 0.00228f}, 0.880f),
      petzold("clear-ocean", "Clear ocean", 0.037f, 0.114f),
      petzold("coastal-water", "Coastal water", 0.219f, 0.179f),
      petzold("harbour-water", "Turbid harbour", 1.824f, 0.366f),
  };
  return all;
}

const MediumPreset* find_medium_preset(std::string_view name) {
  for (const MediumPreset& preset : medium_presets())
    if (preset.name == name) return &preset;
  return nullptr;
}

std::string_view preset_of(const MediumDescription& medium) {
  for (const MediumPreset& preset : medium_presets())
    if (preset.medium.scattering == medium.scattering && preset.medium.absorption == medium.absorption &&
        preset.medium.phase == medium.phase && !medium.has_spectrum())
      return preset.name;
  return kNoMediumPreset;
}

}  // namespace etendue
