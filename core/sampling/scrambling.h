// Randomisations of points in base 2: their coordinates are fractions of 32 bits.       [Lang, sec. 7.3; Owen 1995]
#pragma once
#include <array>

#include "base/parameter.h"
#include "sampling/owen.h"

namespace etendue {

// owen           permutes the halves of the interval, then the halves of each half, and so on; keeps nets, and has the
//                smallest variance
// digital_shift  adds a random digit to each digit, modulo 2; keeps nets
// rotation       adds a random number modulo 1 [Cranley and Patterson 1976]
// none           the same points in every pixel: errors are regular patterns, and the estimate is not unbiased
enum class Scrambling : uint8_t { owen, digital_shift, rotation, none };

}  // namespace etendue

template <>
struct etendue::Options<etendue::Scrambling> {
  static constexpr std::array<etendue::Option, 4> kOptions{{{"owen", "Nested (Owen)"},
                                                            {"digital-shift", "Digital shift"},
                                                            {"rotation", "Rotation (Cranley-Patterson)"},
                                                            {"none", "None"}}};
};

namespace etendue {

// `random`: uniform bits, independent for each pixel and dimension.
constexpr uint32_t scramble(Scrambling scrambling, uint32_t x, uint32_t random) {
  switch (scrambling) {
    case Scrambling::owen:
      return owen_scramble(x, random);
    case Scrambling::digital_shift:
      return x ^ random;
    case Scrambling::rotation:
      return x + random;
    case Scrambling::none:
      break;
  }
  return x;
}

inline Choice<Scrambling> scrambling_parameter() {
  return {"scrambling", "Scrambling", Scrambling::owen,
          "Randomisation of the points. none: the same points in every pixel, for study; errors become patterns"};
}

}  // namespace etendue
