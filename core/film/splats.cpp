#include "film/splats.h"

namespace etendue::film {

void add_rows(std::span<const Splats> lists, int width, int first, int end, std::span<Rgb> image) {
  const auto begin = static_cast<uint32_t>(first * width);
  const uint32_t count = static_cast<uint32_t>(end * width) - begin;
  for (const Splats& list : lists)
    for (const Splat& splat : list)
      if (splat.pixel - begin < count) image[splat.pixel] += splat.radiance;
}

}  // namespace etendue::film
