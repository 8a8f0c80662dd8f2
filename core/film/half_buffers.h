// The number of independent accumulation buffers of a film (film/film.h)
#pragma once
#include <cstdint>

namespace etendue::film {

inline constexpr uint32_t kHalfBuffers = 2;

}  // namespace etendue::film
