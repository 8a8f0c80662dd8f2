// Optical constants of named materials, offered as presets of BSDF models.
//
// [Lang, table 4.1] lists dielectrics. [Lang, table 4.2] lists metals with one value for all colours, which makes a
// grey metal; copper's eta of 0.167 is probably 0.617 with two digits exchanged, so both are offered [Lang, table 4.2,
// corrected].
// The coloured metals are the measured n and k of [Johnson and Christy 1972] (silver, gold, copper) and [Rakic 1995]
// (aluminium; metal_spectra.h). The constants of a colour component are fitted to its reflectance: the Fresnel term by
// wavelength, integrated over illuminant D65 and the CIE 1931 observer for the linear sRGB primaries. The fit minimises
// the squared error over 20 cosines, weighted by the cosine. It deviates by at most 0.0001 (silver), 0.0007 (aluminium)
// and 0.0044 (copper). The red of gold is outside the sRGB gamut, 1.038 at normal incidence, and is limited to 0.9985;
// its green and blue deviate by at most 0.0019. Further dielectrics are measured at 587.6 nm, the helium d line.
#pragma once
#include <array>
#include <vector>

#include "bsdf/bsdf_model_info.h"

namespace etendue {

// Index of refraction eta + i kappa for red, green and blue.
struct ConductorConstants {
  const char *name, *label, *source;
  Vec3 eta, kappa;
};

// Index of refraction, real and equal for all colours.
struct DielectricConstants {
  const char *name, *label, *source;
  float eta;
};

inline constexpr const char *kTable41 = "Lang, table 4.1", *kTable42 = "Lang, table 4.2";

inline const std::array<ConductorConstants, 9> kConductors{{
    {"gold", "Gold (grey)", kTable42, Vec3(0.370f), Vec3(2.820f)},
    {"silver", "Silver (grey)", kTable42, Vec3(0.177f), Vec3(3.638f)},
    {"copper", "Copper (grey)", "Lang, table 4.2, corrected", Vec3(0.617f), Vec3(2.63f)},
    {"copper-printed", "Copper (grey, \u03b7 = 0.167)", "Lang, table 4.2, as printed", Vec3(0.167f), Vec3(2.63f)},
    {"steel", "Steel (grey)", kTable42, Vec3(2.485f), Vec3(3.433f)},
    {"silver-measured", "Silver", "Johnson and Christy 1972", Vec3(0.05684f, 0.05506f, 0.04325f),
     Vec3(4.49743f, 3.54961f, 2.59126f)},
    {"aluminium-measured", "Aluminium", "Rakic 1995", Vec3(1.50162f, 0.98520f, 0.60585f),
     Vec3(7.65130f, 6.54901f, 5.34957f)},
    {"gold-measured", "Gold", "Johnson and Christy 1972", Vec3(0.01000f, 0.49770f, 1.47453f),
     Vec3(5.00000f, 2.25729f, 1.77625f)},
    {"copper-measured", "Copper", "Johnson and Christy 1972", Vec3(0.22904f, 1.04468f, 1.29646f),
     Vec3(3.42073f, 2.62515f, 2.36247f)},
}};

inline const std::array<DielectricConstants, 13> kDielectrics{{
    {"vacuum", "Vacuum", kTable41, 1.0f},
    {"air", "Air at sea level", kTable41, 1.00029f},
    {"ice", "Ice", kTable41, 1.31f},
    {"water", "Water", kTable41, 1.333f},
    {"fused-quartz", "Fused quartz", kTable41, 1.46f},
    {"glass", "Glass, light", kTable41, 1.5f},
    {"glass-dense", "Glass, dense", kTable41, 1.6f},
    {"sapphire", "Sapphire", kTable41, 1.77f},
    {"diamond", "Diamond", kTable41, 2.42f},
    {"n-bk7", "Schott N-BK7", "Schott glass catalogue, at 587.6 nm", 1.51680f},
    {"n-sf11", "Schott N-SF11", "Schott glass catalogue, at 587.6 nm", 1.78472f},
    {"fused-silica", "Fused silica", "Malitson 1965, at 587.6 nm", 1.45846f},
    {"water-measured", "Water at 20 degrees", "Daimon and Masumura 2007, at 587.6 nm", 1.33340f},
}};

// Values of the parameters `fresnel`, `eta` and `kappa` of FresnelParameters.
inline std::vector<ModelPreset> fresnel_presets() {
  std::vector<ModelPreset> presets;
  for (const ConductorConstants& metal : kConductors) {
    ModelPreset preset{metal.name, metal.label, metal.source, {{"fresnel", std::string("conductor")}}};
    for (int k = 0; k < 3; ++k) {
      preset.values.emplace_back(std::string("eta") + Triple::kParts[k], double{metal.eta[k]});
      preset.values.emplace_back(std::string("kappa") + Triple::kParts[k], double{metal.kappa[k]});
    }
    presets.push_back(preset);
  }
  return presets;
}

// Values of a parameter `eta`.
inline std::vector<ModelPreset> dielectric_presets() {
  std::vector<ModelPreset> presets;
  for (const DielectricConstants& d : kDielectrics)
    presets.push_back({d.name, d.label, d.source, {{"eta", double{d.eta}}}});
  return presets;
}

}  // namespace etendue
