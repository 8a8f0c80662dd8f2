// Indices of refraction with names: tables 4.1 and 4.2 of the thesis, and measured ones.
//
// Table 4.2 gives one number for all bands, which is a grey metal. Copper's 0.167 is probably 0.617 with two digits
// changed (E4), and stands beside it. The measured metals are n and k of Johnson and Christy 1972 (silver, gold,
// copper) and of Rakic 1995 (aluminium), averaged over 380 .. 780 nm with the CIE 1931 observer turned to the sRGB
// primaries as weights, each band's weights adding to one. The measured dielectrics are at 587.6 nm, the yellow
// helium line.
#pragma once
#include <array>
#include <vector>

#include "bsdf/bsdf_model_info.h"

namespace etendue {

struct ConductorConstants {
  const char *name, *label, *source;
  Vec3 eta, kappa;
};

struct DielectricConstants {
  const char *name, *label, *source;
  float eta;
};

inline constexpr const char *kTable41 = "Thesis, table 4.1", *kTable42 = "Thesis, table 4.2";

inline const std::array<ConductorConstants, 9> kConductors{{
    {"gold", "Gold (table 4.2, grey)", kTable42, Vec3(0.370f), Vec3(2.820f)},
    {"silver", "Silver (table 4.2, grey)", kTable42, Vec3(0.177f), Vec3(3.638f)},
    {"copper", "Copper (table 4.2 corrected, grey)", "Thesis, table 4.2, with 0.617 for 0.167 (E4)", Vec3(0.617f),
     Vec3(2.63f)},
    {"copper-printed", "Copper (table 4.2 as printed, grey)", "Thesis, table 4.2, as printed", Vec3(0.167f),
     Vec3(2.63f)},
    {"steel", "Steel (table 4.2, grey)", kTable42, Vec3(2.485f), Vec3(3.433f)},
    {"silver-measured", "Silver", "Johnson and Christy 1972", Vec3(0.05528f, 0.05471f, 0.04271f),
     Vec3(4.30240f, 3.53638f, 2.53525f)},
    {"aluminium-measured", "Aluminium", "Rakic 1995", Vec3(1.44804f, 0.98394f, 0.58580f),
     Vec3(7.56921f, 6.55791f, 5.30688f)},
    {"gold-measured", "Gold", "Johnson and Christy 1972", Vec3(0.10475f, 0.49154f, 1.47733f),
     Vec3(3.51907f, 2.32971f, 1.81014f)},
    {"copper-measured", "Copper", "Johnson and Christy 1972", Vec3(0.23314f, 1.04107f, 1.29761f),
     Vec3(3.25539f, 2.59409f, 2.35321f)},
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
    {"n-bk7", "Schott N-BK7", "Schott, at 587.6 nm", 1.51680f},
    {"n-sf11", "Schott N-SF11", "Schott, at 587.6 nm", 1.78472f},
    {"fused-silica", "Fused silica", "Malitson 1965, at 587.6 nm", 1.45846f},
    {"water-measured", "Water at 20 degrees", "Daimon and Masumura 2007, at 587.6 nm", 1.33340f},
}};

// Settings of the knobs `eta`, `kappa` and `fresnel` of FresnelParameters.
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

// Settings of a single knob `eta`.
inline std::vector<ModelPreset> dielectric_presets() {
  std::vector<ModelPreset> presets;
  for (const DielectricConstants& d : kDielectrics)
    presets.push_back({d.name, d.label, d.source, {{"eta", double{d.eta}}}});
  return presets;
}

}  // namespace etendue
