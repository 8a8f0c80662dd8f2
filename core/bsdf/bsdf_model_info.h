// What a reflection model says about itself.
#pragma once
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "base/parameter.h"
#include "spectrum/rgb.h"

namespace etendue {

// The classes of thesis 4.2.2.5, by which menus are grouped.
enum class ModelClass : uint8_t { idealised, phenomenological, physical, measured };

struct BsdfModelDescription {
  const char* name;   // as commands know it
  const char* label;  // as menus show it
  ModelClass model_class;
  const char* summary;   // the formula and where it comes from, in two or three sentences
  const char* sampling;  // how directions are drawn
};

// Values for several parameters at once that have a name of their own.
struct ModelPreset {
  std::string name, label, source;
  std::vector<std::pair<std::string, Value>> values;
};

inline Rgb rgb_of(const Triple& knob) { return {knob.value.x, knob.value.y, knob.value.z}; }

}  // namespace etendue

template <>
struct etendue::Options<etendue::ModelClass> {
  static constexpr std::array<etendue::Option, 4> kOptions{{{"idealised", "Idealised"},
                                                            {"phenomenological", "Phenomenological"},
                                                            {"physical", "Physically based"},
                                                            {"measured", "Measured"}}};
};
