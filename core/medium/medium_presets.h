// Named media with measured coefficients.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "medium/medium.h"

namespace etendue {

struct MediumPreset {
  std::string name, label;
  std::string source;  // keys of docs/references.md, and how the coefficients follow from them
  MediumDescription medium;
};

inline constexpr const char* kNoMediumPreset = "custom";

const std::vector<MediumPreset>& medium_presets();
// Null if no preset has this name.
const MediumPreset* find_medium_preset(std::string_view name);
// The name of the preset with these coefficients and this phase function, or kNoMediumPreset.
std::string_view preset_of(const MediumDescription& medium);

}  // namespace etendue
