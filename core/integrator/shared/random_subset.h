// Random subsets of stored photons and virtual lights, to bound their number.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/hash.h"

namespace etendue::integrator {

// Keeps a random subset of `most` elements if there are more, in their order. All subsets of this size are equally likely
// [Knuth 1997, algorithm 3.4.2S]. scale(element, factor) multiplies the weight of an element, so that the expectation of
// every sum over them is unchanged.
template <class T, class Scale>
void thin_randomly(std::vector<T>& elements, size_t most, uint32_t seed, Scale&& scale) {
  const size_t count = elements.size();
  if (count <= most) return;
  const float factor = static_cast<float>(count) / static_cast<float>(most);
  size_t kept = 0;
  for (size_t i = 0; kept < most; ++i) {
    const size_t left = count - i, wanted = most - kept;
    const float random = to_unit_float(hash_combine(seed, static_cast<uint32_t>(i)));
    if (left > wanted && random * static_cast<float>(left) >= static_cast<float>(wanted)) continue;
    elements[kept] = elements[i];
    scale(elements[kept++], factor);
  }
  elements.resize(most);
}

}  // namespace etendue::integrator
