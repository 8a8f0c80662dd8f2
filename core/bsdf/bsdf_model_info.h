// The description of a BSDF model: what menus, `etendue list materials` and the generated manual print.
#pragma once
#include <array>
#include <source_location>
#include <string>
#include <utility>
#include <vector>

#include "base/parameter.h"
#include "spectrum/rgb.h"

namespace etendue {

// The classes by which menus group models [Lang, sec. 4.2.2.5].
enum class ModelClass : uint8_t { idealised, phenomenological, physical, measured };

// Texts are plain ASCII. Formulas use wo, wi for directions, h for the half vector, cos_o, cos_i, cos_h for their
// cosines to the normal, <a, b> for dot products, r for the mirror direction of wo.
struct BsdfModelDescription {
  const char* name = "";   // identifier in commands and files, e.g. "ward"
  const char* label = "";  // shown in menus
  ModelClass model_class = ModelClass::phenomenological;
  const char* summary = "";      // one or two sentences
  const char* formula = "";      // lines are separated by \n
  const char* properties = "";   // reciprocity and energy conservation
  const char* sampling = "";     // how directions are sampled
  const char* limitations = "";  // known deviations from physics or from the source
  const char* source = "";       // keys of docs/references.md
  // The source file that contains the description, for the manual.
  const char* file = std::source_location::current().file_name();
};

// A named set of parameter values, such as the optical constants of a metal.
struct ModelPreset {
  std::string name, label, source;
  std::vector<std::pair<std::string, Value>> values;
};

inline Rgb rgb_of(const Triple& parameter) { return {parameter.value.x, parameter.value.y, parameter.value.z}; }

}  // namespace etendue

template <>
struct etendue::Options<etendue::ModelClass> {
  static constexpr std::array<etendue::Option, 4> kOptions{{{"idealised", "Idealised"},
                                                            {"phenomenological", "Phenomenological"},
                                                            {"physical", "Physically based"},
                                                            {"measured", "Measured"}}};
};
